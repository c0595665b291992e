/**
 * `npm start -- a.skel a.skin walk.anim`: a plugin for the development server that serves exactly the files named on
 * the command line and opens the page with them.
 *
 *     /given/0/a.skel      file a.skel of the first folder that was named
 *     /given/1/a.skel      a file of the same name from another folder: files of one folder belong together
 *
 * Without arguments: `test.skel`, `test.skin`, `test.anim` of the caller's folder if present, as the assignment asks;
 * else the plain page with its example.
 *
 * Addresses are looked up in a table, never resolved as paths, so nothing else can be reached. (Vite's own `/@fs/`
 * would serve them too, but would expose whole folders to the page.)
 */
import { createReadStream, existsSync, statSync } from 'node:fs';
import { basename, delimiter, dirname, join } from 'node:path';
import type { Plugin } from 'vite';
import { callersFolder, findGiven, type GivenPath } from '../src/cli/paths.ts';
import { printableLine } from '../src/cli/printable.ts';

const DEFAULTS = ['test.skel', 'test.skin', 'test.anim'];

/** Decoded addresses below the server's root, and their files. */
export type GivenTable = ReadonlyMap<string, string>;

export function givenFiles(): Plugin {
  let table: GivenTable = new Map();
  return {
    name: 'marrow-given-files',
    apply: 'serve',
    config(config) {
      // Only `npm start` opens a browser; tests and a plain `vite` serve nothing but the page.
      if (!config.server?.open) return undefined;
      const end = process.argv.indexOf('--');
      const args = end < 0 ? [] : process.argv.slice(end + 1);
      const folder = callersFolder('start');
      const { files, missing } = findGiven(args.length ? args : defaultsIn(folder), folder);
      if (missing.length || (args.length && !files.length)) {
        for (const { path, why } of missing) console.error(printableLine(`marrow: ${path}: ${why}`));
        if (!missing.length) console.error(`marrow: there are no files in ${args.join(' ')}.`);
        process.exit(2);
      }
      table = tableOf(files);
      return { server: { open: canOpen() && (table.size ? `/${queryOf(table)}` : true) } };
    },
    configureServer(server) {
      server.middlewares.use((request, response, next) => {
        const file = table.get(decoded(new URL(request.url ?? '/', 'http://localhost').pathname));
        const stats = file === undefined ? undefined : statSync(file, { throwIfNoEntry: false });
        if (file === undefined || !stats) return next();
        // Read on each request: the file may be edited meanwhile.
        response.writeHead(200, {
          'content-type': 'application/octet-stream',
          'content-length': stats.size,
          'cache-control': 'no-store',
          // *Reload from disk* compares this to find changed files.
          etag: `"${stats.mtimeMs}-${stats.size}"`,
        });
        // A file deleted meanwhile ends this response, not the server.
        createReadStream(file)
          .on('error', () => response.destroy())
          .pipe(response);
      });
      if (table.size === 0) return;
      const printUrls = server.printUrls;
      // Print the full address, for when no browser opens.
      server.printUrls = () => {
        printUrls();
        for (const url of server.resolvedUrls?.local ?? []) console.log(`  ➜  Files:   ${url}${queryOf(table)}`);
      };
    },
  };
}

/** Files of one folder share a number. */
export function tableOf(files: readonly GivenPath[]): GivenTable {
  const folders: string[] = [];
  return new Map(
    files.map(({ absolute }) => {
      const folder = dirname(absolute);
      if (!folders.includes(folder)) folders.push(folder);
      return [`/given/${folders.indexOf(folder)}/${basename(absolute)}`, absolute];
    }),
  );
}

/** `?files=given/0/a.skel,given/0/b%2Cc.skin`: commas separate addresses, so those in names are encoded. */
export function queryOf(table: GivenTable): string {
  const addresses = [...table.keys()].map((address) => address.slice(1).split('/').map(encodeURIComponent).join('/'));
  return `?files=${addresses.join(',')}`;
}

function defaultsIn(folder: string): string[] {
  return DEFAULTS.filter((name) => statSync(join(folder, name), { throwIfNoEntry: false })?.isFile());
}

/** A server or container may have no browser: then the printed address has to do. */
function canOpen(): boolean {
  if (process.platform !== 'linux' || process.env.BROWSER || process.env.WSL_DISTRO_NAME) return true;
  return (process.env.PATH ?? '').split(delimiter).some((folder) => existsSync(join(folder, 'xdg-open')));
}

function decoded(path: string): string {
  try {
    return decodeURIComponent(path);
  } catch {
    return path;
  }
}
