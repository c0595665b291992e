/** Threads that read hostile files: built, and with little space for new objects, which `memory.ts` asks for. */
import { fileURLToPath } from 'node:url';
import { setFlagsFromString } from 'node:v8';
import { Worker } from 'node:worker_threads';
import { build } from 'vite';
import { draco } from '../../../plugins/draco.ts';
import { NEW_SPACE_MB } from './memory.ts';

const ROOT = fileURLToPath(new URL('../../../', import.meta.url));
const MAX_HEAP_MB = 2000;

/** One script, which runs as fast as the page's. @returns its path */
export async function buildThread(name: 'thread' | 'asked-thread'): Promise<string> {
  const outDir = `${ROOT}node_modules/.cache/marrow-attack/${name}/`;
  await build({
    configFile: false,
    root: ROOT,
    logLevel: 'warn',
    plugins: [draco()],
    ssr: { noExternal: true },
    build: {
      ssr: `tests/attack/readers/${name}.ts`,
      outDir,
      emptyOutDir: true,
      copyPublicDir: false,
      target: 'node20',
      rolldownOptions: { output: { entryFileNames: 'thread.js', format: 'es' } },
    },
  });
  return `${outDir}thread.js`;
}

export function startThread(script: string, workerData?: unknown): Worker {
  // A thread that is ended while it measures leaves this on for the whole process.
  setFlagsFromString('--no-gc-global');
  return new Worker(script, {
    workerData,
    resourceLimits: { maxOldGenerationSizeMb: MAX_HEAP_MB, maxYoungGenerationSizeMb: NEW_SPACE_MB },
  });
}
