/** A module as it ships: in one bundle with all that it imports. Vitest itself puts a look-up before every call. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { build } from 'vite';

/** @param path of a module, from the top of the project */
export async function bundled<Module>(path: string): Promise<Module> {
  const made = await build({
    configFile: false,
    logLevel: 'error',
    build: { ssr: path, write: false, target: 'node20' },
    ssr: { noExternal: true },
  });
  const [output] = [made].flat();
  if (!('output' in output)) throw new Error(`${path} was not built`);
  const folder = mkdtempSync(join(tmpdir(), 'marrow-'));
  try {
    const file = join(folder, 'bundle.mjs');
    writeFileSync(file, output.output[0].code);
    // What a file exports is for whoever asks to know.
    return (await import(/* @vite-ignore */ pathToFileURL(file).href)) as Module;
  } finally {
    rmSync(folder, { recursive: true });
  }
}
