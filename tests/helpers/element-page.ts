/**
 * A page of somebody's with `<marrow-viewer>` in it, as `npm run build:package` makes that, and our examples beside. The
 * server sends the policy of the workbench's page, which forbids inline scripts and styles, so they are files, too.
 */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { type OpenPage, type PageOptions, withPage } from './page.ts';
import type { ExtraFiles } from './server.ts';

export const ELEMENT = fileURLToPath(new URL('../../build/package/element', import.meta.url));
const SAMPLES = fileURLToPath(new URL('../../public/samples/', import.meta.url));

const samples: ExtraFiles = Object.fromEntries(
  readdirSync(SAMPLES)
    .filter((name) => !name.endsWith('.json'))
    .map((name) => [name, readFileSync(join(SAMPLES, name))]),
);

/** The page's own policy for trusted types, which the server's asks for. */
const ALLOW = "window.trustedTypes?.createPolicy('default', { createScriptURL: (address) => address });";

const STYLE = `
  body { margin: 16px; font: 16px/1.5 system-ui, sans-serif; }
  marrow-viewer { width: 240px; }
  .many { display: grid; grid-template-columns: repeat(8, 1fr); gap: 4px; }
  .many marrow-viewer { width: auto; }
`;

export interface ElementPage extends Omit<PageOptions, 'folder'> {
  /** Of the body. */
  readonly html: string;
  /** Without it no worker can be started. Default true. */
  readonly allowsWorkers?: boolean;
  /** Further rules of the page. */
  readonly style?: string;
}

/** Opens such a page. The elements may still be loading. */
export function withElement(
  { html, files = {}, allowsWorkers = true, style = '', ...options }: ElementPage,
  body: (open: OpenPage) => Promise<void>,
): Promise<void> {
  const page: ExtraFiles = {
    'index.html': `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>A page</title>
<link rel="stylesheet" href="page.css">
<script src="page.js"></script><script type="module" src="marrow-viewer.js"></script></head>
<body>${html}</body></html>`,
    'page.css': STYLE + style,
    'page.js': allowsWorkers ? ALLOW : '',
  };
  const early = { folder: ELEMENT, walking: true, early: true, fullMotion: true, drawn: true } as const;
  return withPage(body, { ...early, ...options, files: { ...samples, ...page, ...files } });
}
