/**
 * What makes the built page an app: its web app manifest, and its service worker with the list of all built files.
 *
 *     manifest.webmanifest   name, icons, and the files that the system opens with the page once it is installed
 *     sw.js                  src/offline/service-worker.ts, with each file's path and hash; so it changes whenever a
 *                            file does, which is how browsers notice a new version
 *
 * By hand, since vite-plugin-pwa would bring Workbox and some 280 other packages for these two files, and its runtime
 * neither checks what it stores nor keeps an open page's scripts when a new version takes over.
 */
import { createHash } from 'node:crypto';
import { readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build, type Plugin } from 'vite';
import { FORMAT_KINDS, KINDS, type Kind } from '../src/files/kinds.ts';
import { textureMime } from '../src/formats/texture/read.ts';
import type { BuiltFiles } from '../src/offline/stored-page.ts';

const MANIFEST = 'manifest.webmanifest';
const WORKER = 'sw.js';
const WORKER_SOURCE = fileURLToPath(new URL('../src/offline/service-worker.ts', import.meta.url));

export function offline(): Plugin {
  return {
    name: 'marrow-offline',
    apply: 'build',
    // Not in index.html, since the development server has no manifest.
    transformIndexHtml: () => [
      { tag: 'link', attrs: { rel: 'manifest', href: `./${MANIFEST}`, crossorigin: 'use-credentials' } },
    ],
    generateBundle() {
      this.emitFile({ type: 'asset', fileName: MANIFEST, source: JSON.stringify(webAppManifest()) });
    },
    async writeBundle({ dir }) {
      if (dir !== undefined) writeFileSync(join(dir, WORKER), await serviceWorker(builtFiles(dir)));
    },
  };
}

/** https://www.w3.org/TR/appmanifest/; relative addresses, so it works under any path. */
export function webAppManifest() {
  const image = (name: string, size: number, purpose: 'any' | 'maskable') => {
    return { src: `icons/${name}`, sizes: `${size}x${size}`, type: 'image/png', purpose };
  };
  return {
    name: 'Marrow',
    short_name: 'Marrow',
    description: 'A workbench for text-based character animation',
    lang: 'en',
    start_url: '.',
    scope: '.',
    display: 'standalone',
    // Before the page is open; then its own `theme-color` applies, which follows the theme.
    theme_color: '#212427',
    background_color: '#212427',
    icons: [
      { src: 'icons/icon.svg', sizes: 'any', type: 'image/svg+xml', purpose: 'any' },
      image('icon-192.png', 192, 'any'),
      image('icon-512.png', 512, 'any'),
      image('maskable-512.png', 512, 'maskable'),
    ],
    file_handlers: [{ action: '.', accept: acceptedFiles() }],
    // A file that is opened goes to the window that is open already, which may have unsaved changes.
    launch_handler: { client_mode: ['focus-existing', 'auto'] },
  };
}

/** Extensions by MIME type, of every kind of file that is told by them. */
function acceptedFiles(): Readonly<Record<string, readonly string[]>> {
  const accepted: Record<string, string[]> = {};
  for (const kind of FORMAT_KINDS) {
    const { extensions, isRare }: Kind = KINDS[kind];
    if (isRare) continue;
    for (const extension of extensions) {
      // Our text formats have no registered types; with a made-up one, the system doesn't offer us all text files.
      const type = kind === 'texture' ? textureMime(extension) : `application/x-${extension}`;
      accepted[type] = [...(accepted[type] ?? []), `.${extension}`];
    }
  }
  return accepted;
}

/** All files in a folder that the page may request, and their hashes. */
export function builtFiles(folder: string): BuiltFiles {
  const paths = readdirSync(folder, { recursive: true, encoding: 'utf8' })
    .filter((path) => statSync(join(folder, path)).isFile())
    .map((path) => path.replaceAll('\\', '/'))
    // Source maps are for developer tools only.
    .filter((path) => !path.endsWith('.map') && path !== WORKER)
    .sort();
  return Object.fromEntries(paths.map((path) => [encodeURI(path), integrityOf(readFileSync(join(folder, path)))]));
}

/** As in an `integrity` attribute. */
function integrityOf(content: Uint8Array): string {
  return `sha256-${createHash('sha256').update(content).digest('base64')}`;
}

async function serviceWorker(files: BuiltFiles): Promise<string> {
  const made = await build({
    configFile: false,
    logLevel: 'warn',
    publicDir: false,
    define: { BUILT_FILES: JSON.stringify(files) },
    build: { write: false, lib: { entry: WORKER_SOURCE, formats: ['iife'], name: 'serviceWorker' } },
  });
  const [output] = [made].flat();
  if (!('output' in output)) throw new Error(`${WORKER_SOURCE} was not built.`);
  return output.output[0].code;
}
