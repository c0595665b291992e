/** `npm start` as a process: what it serves, what it doesn't, and what it refuses. */
import { type ChildProcess, spawn } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { request } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const VITE = join(ROOT, 'node_modules', 'vite', 'bin', 'vite.js');
let folder = '';
const started: ChildProcess[] = [];

beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-'));
  for (const sub of ['one', 'two', 'empty', 'assignment']) mkdirSync(join(folder, sub));
  writeFileSync(join(folder, 'one', 'x,y 50%.skel'), 'one');
  writeFileSync(join(folder, 'two', 'x,y 50%.skel'), 'two');
  writeFileSync(join(folder, 'two', 'secret.txt'), 'secret');
  writeFileSync(join(folder, 'assignment', 'test.skel'), 'skel');
  writeFileSync(join(folder, 'assignment', 'test.anim'), 'anim');
});
// It would go on preparing what a browser may ask for.
afterEach(() => {
  for (const child of started.splice(0)) child.kill();
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

interface Started {
  /** Its output so far. */
  text(): string;
  /** The page's address; empty if the process ended instead. */
  readonly url: string;
  readonly code: number | null;
}

const WITH_FILES = /Files: +(\S+)\n/;
const PLAIN = /Local: +(\S+)\n/;

/**
 * Runs the script of package.json directly, with npm's environment; npm itself would be another process to end.
 * Resolves when the address is printed, or the process has ended.
 */
function start(from: string, args: readonly string[], address: RegExp): Promise<Started> {
  const child = spawn(process.execPath, [VITE, '--open', '--', ...args], {
    cwd: ROOT,
    env: {
      ...process.env,
      NO_COLOR: '1',
      FORCE_COLOR: '0',
      BROWSER: 'none',
      INIT_CWD: from,
      npm_lifecycle_event: 'start',
      npm_package_json: join(ROOT, 'package.json'),
    },
  });
  started.push(child);
  return new Promise((resolve) => {
    let text = '';
    const told = () => text;
    const listen = (part: Buffer) => {
      text += part;
      const url = address.exec(text)?.[1];
      if (url) resolve({ text: told, code: null, url });
    };
    child.stdout.on('data', listen);
    child.stderr.on('data', listen);
    child.once('close', (code) => resolve({ text: told, code, url: '' }));
  });
}

/** Status and body; the path is sent as written, while `fetch` would normalise `..`. */
function get(base: string, path: string): Promise<{ status: number; body: string }> {
  return new Promise((resolve, reject) => {
    const { hostname, port } = new URL(base);
    request({ hostname, port, path }, (response) => {
      let body = '';
      response.on('data', (part) => {
        body += part;
      });
      response.on('end', () => resolve({ status: response.statusCode ?? 0, body }));
    })
      .on('error', reject)
      .end();
  });
}

describe('npm start', () => {
  it('serves exactly the files named, and opens the page with them', async () => {
    const { url } = await start(folder, ['one/x,y 50%.skel', 'two/x,y 50%.skel'], WITH_FILES);
    const addresses = new URL(url).search.replace('?files=', '').split(',');
    expect(addresses).toEqual(['given/0/x%2Cy%2050%25.skel', 'given/1/x%2Cy%2050%25.skel']);
    const served = await Promise.all(addresses.map((address) => get(url, `/${address}`)));
    expect(served).toEqual([
      { status: 200, body: 'one' },
      { status: 200, body: 'two' },
    ]);
    const elsewhere = ['given/1/secret.txt', 'given/0/../1/secret.txt', 'given/1/%2e%2e/two/secret.txt', 'given/2/x'];
    for (const path of elsewhere) {
      const { body } = await get(url, `/${path}`);
      expect(body).not.toContain('secret');
    }
  });

  it("opens the assignment's files of the caller's folder where there are such", async () => {
    const { url } = await start(join(folder, 'assignment'), [], WITH_FILES);
    expect(new URL(url).search).toBe('?files=given/0/test.skel,given/0/test.anim');
  });

  it('opens the plain page where there are none', async () => {
    const { url, text } = await start(join(folder, 'empty'), [], PLAIN);
    // When it answers, all of its startup output is printed.
    const { status } = await get(url, '/');
    expect(status).toBe(200);
    expect(text()).not.toContain('Files:');
  });

  it('names a file that is not there and ends with 2', async () => {
    const { code, text } = await start(folder, ['one', 'gone.skel'], PLAIN);
    expect(code).toBe(2);
    const lines = text().trim().split('\n');
    expect(lines.at(-1)).toBe(`marrow: gone.skel: There is no such file in ${folder}.`);
    // On a busy machine Vite tells first how long its configuration took. Of the file nothing else is said.
    expect(lines.filter((line) => /marrow:|gone\.skel|^ +at /.test(line))).toHaveLength(1);
  });
});
