/** The test kit as one zip. Loaded on first use, with the zip library; the worker makes the files. */
import { zipFiles } from '../io/zip-files.ts';
import type { Runs } from '../worker/client.ts';

const NAME = 'marrow-kit';

/** Rejects if the worker fails. */
export async function kitZip(
  worker: Runs<'kit'>,
): Promise<{ readonly name: string; readonly bytes: Uint8Array<ArrayBuffer> }> {
  const files = [...(await worker.run('kit', undefined))].map(([name, content]) => ({ name, content }));
  return { name: `${NAME}.zip`, bytes: zipFiles(NAME, files) };
}
