/**
 * The scripts and the style of the pages that characters are saved in (`src/files/web-page/`), as a module for page,
 * worker and command:
 *
 *     import { viewer, loader, style, policy } from 'virtual:web-page';
 *
 * The viewer is the element with all that such a page needs, in one script. The policy allows the hashes of these and
 * nothing else, so that no text of a file can ever be run, whatever is wrong with the page.
 */
import { createHash } from 'node:crypto';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';
import { build, type Plugin, type Rolldown } from 'vite';
import type { PageScripts } from '../src/files/web-page/web-page.ts';
import { toBase91 } from '../src/formats/base91.ts';

const NAME = 'virtual:web-page';
const FOLDER = fileURLToPath(new URL('../src/viewer/saved/', import.meta.url));

const STYLE = `:root{color-scheme:light;background:#f7f8fa}:root[data-theme=dark]{color-scheme:dark;background:#1b1e21}
marrow-viewer{position:fixed;inset:0;aspect-ratio:auto;--touch-action:none}[hidden]{display:none}
p,noscript{font:16px/1.5 system-ui,sans-serif;padding:1em}`;

export function webPageScripts(): Plugin {
  return {
    name: 'marrow-web-page',
    resolveId: (id) => (id === NAME ? `\0${NAME}` : undefined),
    load: async (id) => (id === `\0${NAME}` ? moduleOf(await pageScripts()) : undefined),
  };
}

let made: Promise<PageScripts> | undefined;

/** Built once for all that ask. */
export function pageScripts(): Promise<PageScripts> {
  made ??= scripts();
  return made;
}

async function scripts(): Promise<PageScripts> {
  const [viewer, loader] = await Promise.all([scriptOf('page'), scriptOf('loader')]);
  // It is in the page as it is.
  if (/<[!/]/.test(loader)) throw new Error('The loader of the saved page would end its own script.');
  const hash = (text: string) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
  const policy = [
    "default-src 'none'",
    `script-src ${hash(viewer)} ${hash(loader)}`,
    `style-src ${hash(STYLE)}`,
    "base-uri 'none'",
    "form-action 'none'",
  ].join('; ');
  return { viewer: toBase91(deflateRawSync(viewer, { level: 9 })), loader, style: STYLE, policy };
}

async function scriptOf(name: string): Promise<string> {
  const built = await build({
    configFile: false,
    logLevel: 'warn',
    publicDir: false,
    plugins: [ownReading()],
    resolve: { alias: [{ find: /^fflate$/, replacement: 'fflate/browser' }] },
    ssr: { noExternal: true },
    build: {
      ssr: true,
      write: false,
      target: 'es2023',
      minify: true,
      rolldownOptions: { input: { [name]: `${FOLDER}${name}.ts` }, output: { codeSplitting: false } },
    },
  });
  const { output } = built as Rolldown.RolldownOutput;
  const [{ code }] = output;
  if (output.length > 1) throw new Error(`${name} of the saved page is more than one script.`);
  return code.trim();
}

/** A saved page reads its own files. */
function ownReading(): Plugin {
  return {
    name: 'marrow-own-reading',
    enforce: 'pre',
    resolveId: (id, from) =>
      id === './reading.ts' && from?.endsWith('/viewer/element.ts') ? `${FOLDER}reading.ts` : undefined,
  };
}

function moduleOf(scripts: PageScripts): string {
  return Object.entries(scripts)
    .map(([name, text]) => `export const ${name} = ${JSON.stringify(text)};\n`)
    .join('');
}
