/** The page of three.js alone, bundled, as files to serve. */
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import type { ExtraFiles } from '../../../helpers/server.ts';

/** Their paths begin with this; its page is `index.html`. */
export const PEER_FOLDER = 'three-alone/';

export async function builtPeer(): Promise<ExtraFiles> {
  const made = await build({
    root: fileURLToPath(new URL('.', import.meta.url)),
    configFile: false,
    logLevel: 'error',
    base: './',
    // Waiting at the top of a module needs it.
    build: { write: false, target: 'es2022', chunkSizeWarningLimit: 2000 },
  });
  const [output] = [made].flat();
  if (!output || !('output' in output)) throw new Error('The page of three.js alone was not built.');
  const files = output.output.map((file) => [file.fileName, file.type === 'chunk' ? file.code : file.source] as const);
  return Object.fromEntries(files.map(([name, content]) => [PEER_FOLDER + name, content]));
}
