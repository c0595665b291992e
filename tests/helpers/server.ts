/**
 * A plain static host: the files of a folder under a sub-path, with the headers of docs/hosting.md; 404 for everything
 * else. Vite's own preview answers unknown addresses with the page, which would hide wrong addresses.
 */
import { readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize, sep } from 'node:path';
import { HEADERS, POLICY } from '../../plugins/policy.ts';

/** Files served in addition to the folder's, by their path below the sub-path: `given/a.skel`. */
export type ExtraFiles = Readonly<Record<string, Uint8Array | string>>;

export interface StaticServer {
  /** Including the sub-path, ending with `/`. */
  readonly url: string;
  /** Replaces the extra files, for a test's `?files=`. If two have the same path, the first is served. */
  serve(...extra: readonly ExtraFiles[]): void;
  /** Paths asked for since the extra files were replaced. */
  readonly asked: readonly string[];
  close(): Promise<void>;
}

const TYPES: Readonly<Record<string, string>> = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.json': 'application/json',
  '.webmanifest': 'application/manifest+json',
  '.map': 'application/json',
  '.svg': 'image/svg+xml',
  '.png': 'image/png',
  '.jpg': 'image/jpeg',
  '.webp': 'image/webp',
  '.gif': 'image/gif',
  '.bmp': 'image/bmp',
  '.ico': 'image/x-icon',
};

/** Read once by each process. */
const read = new Map<string, { readonly changed: number; readonly content: Buffer }>();

/** Of a file as it is now. @param changed milliseconds */
function contentOf(file: string, changed: number): Buffer {
  const before = read.get(file);
  if (before?.changed === changed) return before.content;
  const content = readFileSync(file);
  read.set(file, { changed, content });
  return content;
}

/**
 * @param subPath begins and ends with `/`
 * @param framedBy pages that may frame it, as in a policy
 */
export async function serveFolder(folder: string, subPath: string, framedBy?: string): Promise<StaticServer> {
  let extra: readonly ExtraFiles[] = [];
  let asked: string[] = [];
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url ?? '/', 'http://localhost');
    if (!pathname.startsWith(subPath)) return void response.writeHead(404).end();
    const path = decodeURIComponent(pathname.slice(subPath.length)) || 'index.html';
    asked.push(pathname.slice(subPath.length));
    const framing = framedBy && { 'Content-Security-Policy': `${POLICY}; frame-ancestors ${framedBy}` };
    const headers = {
      ...HEADERS,
      ...framing,
      'content-type': TYPES[extname(path).toLowerCase()] ?? 'application/octet-stream',
    };

    const given = extra.find((files) => Object.hasOwn(files, path))?.[path];
    if (given !== undefined) return void response.writeHead(200, headers).end(given);

    const file = join(folder, normalize(path));
    const stats = file.startsWith(folder + sep) ? statSync(file, { throwIfNoEntry: false }) : undefined;
    if (!stats?.isFile()) return void response.writeHead(404).end();
    response.writeHead(200, { ...headers, 'content-length': stats.size });
    response.end(contentOf(file, stats.mtimeMs));
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  const address = server.address();
  if (address === null || typeof address === 'string') throw new Error('The test server has no port.');
  return {
    url: `http://127.0.0.1:${address.port}${subPath}`,
    serve(...files) {
      extra = files;
      asked = [];
    },
    get asked() {
      return asked;
    },
    close: () =>
      new Promise((resolve) => {
        server.close(() => resolve());
        server.closeAllConnections();
      }),
  };
}
