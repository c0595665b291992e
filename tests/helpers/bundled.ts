/** A module as it ships: bundled with all its imports. Vitest itself adds a look-up to every call. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { build } from 'vite';
import { draco } from '../../plugins/draco.ts';

/** @param path of a module, relative to the project */
export async function bundled<Module>(path: string): Promise<Module> {
  const made = await build({
    configFile: false,
    logLevel: 'error',
    plugins: [draco()],
    build: { ssr: path, write: false, target: 'node20' },
    ssr: { noExternal: true },
  });
  const [output] = [made].flat();
  if (!('output' in output)) throw new Error(`${path} was not built`);
  const folder = mkdtempSync(join(tmpdir(), 'marrow-'));
  try {
    const file = join(folder, 'bundle.mjs');
    writeFileSync(file, output.output[0].code);
    // The caller states the type of what the file exports.
    return (await import(/* @vite-ignore */ pathToFileURL(file).href)) as Module;
  } finally {
    rmSync(folder, { recursive: true });
  }
}
