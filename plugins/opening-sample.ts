/**
 * The example that the page opens with, read at build time: the page shows it without a reader, which is a third of all
 * script, and without the example's text.
 *
 *     import { address } from 'virtual:opening-sample';      undefined in development, where it is read like the others
 */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { type Plugin, runnerImport } from 'vite';

const ID = 'virtual:opening-sample';
const SAMPLES = fileURLToPath(new URL('../public/samples/', import.meta.url));
/** Imported when it is needed: the readers would make every command of Vite slower. */
const PACKING = fileURLToPath(new URL('../examples/characters/packed.ts', import.meta.url));

export function openingSample(): Plugin {
  let isBuilt = false;
  return {
    name: 'marrow-opening-sample',
    configResolved({ command }) {
      isBuilt = command === 'build';
    },
    resolveId: (id) => (id === ID ? `\0${ID}` : undefined),
    async load(id) {
      if (id !== `\0${ID}`) return undefined;
      if (!isBuilt) return 'export const address = undefined;';
      const source = await packedOpening();
      const asset = this.emitFile({ type: 'asset', name: 'opening.json', source });
      return `export const address = import.meta.ROLLUP_FILE_URL_${asset};`;
    },
  };
}

async function packedOpening(): Promise<string> {
  const [first] = JSON.parse(readFileSync(`${SAMPLES}samples.json`, 'utf8'));
  const contents = first.files.map((name: string) => new Uint8Array(readFileSync(SAMPLES + name)));
  const { module } = await runnerImport<typeof import('../examples/characters/packed.ts')>(PACKING, {
    configFile: false,
    logLevel: 'warn',
  });
  return module.packedExample(first, contents);
}
