/** The examples of `<marrow-viewer>` in `examples/code/`, as they are. */
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import type { MarrowViewer } from '../../src/package/viewer.ts';
import { ELEMENT } from '../helpers/element-page.ts';
import { fillNoPixels, sharedChromium } from '../helpers/page.ts';

const CODE = fileURLToPath(new URL('../../examples/code', import.meta.url));
const SAMPLES = fileURLToPath(new URL('../../public/samples', import.meta.url));
const TYPES: Readonly<Record<string, string>> = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript' };

/** Opens a page of a plain server that has these folders, and one page more. */
async function onServer(
  page: string,
  made: string,
  body: (viewers: () => Promise<readonly number[]>, tab: Page) => Promise<void>,
) {
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url ?? '/', 'http://localhost').pathname);
    const headers = { 'content-type': TYPES[extname(path)] ?? 'application/octet-stream' };
    if (path === `/${made}`) return void response.writeHead(200, headers).end(page);
    for (const folder of [ELEMENT, CODE, SAMPLES]) {
      try {
        const content = readFileSync(join(folder, path));
        return void response.writeHead(200, headers).end(content);
      } catch {
        // In another one.
      }
    }
    response.writeHead(404).end();
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  const browser = await sharedChromium();
  const tab = await browser.newPage({ reducedMotion: 'no-preference' });
  try {
    await tab.addInitScript(fillNoPixels, false);
    // Listening on a port, so it has one.
    await tab.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/${made}`);
    await body(async () => {
      const frames = await Promise.all(
        tab
          .frames()
          .map((frame) =>
            frame.evaluate(() =>
              [...document.querySelectorAll<MarrowViewer>('marrow-viewer')].flatMap(({ joints, currentTime }) =>
                joints?.length ? [currentTime] : [],
              ),
            ),
          ),
      );
      return frames.flat();
    }, tab);
  } finally {
    await tab.close();
    server.closeAllConnections();
    server.close();
  }
}

it('the example of two characters in step: the second follows the time of the first', () =>
  onServer(readFileSync(join(CODE, 'two-in-step.html'), 'utf8'), 'two-in-step.html', async (times) => {
    await expect.poll(async () => (await times()).length).toBe(2);
    await expect.poll(async () => Math.min(...(await times()))).toBeGreaterThan(0.1);
  }));

it('elements in a frame wait until the frame is seen', () =>
  onServer(
    '<!doctype html><div style="height:3000px"></div><iframe src="two-in-step.html" width="600" height="900"></iframe>',
    'around.html',
    async (times, tab) => {
      await expect.poll(async () => (await times()).length).toBe(2);
      const unseen = await times();
      expect(unseen).toEqual([0, 0]);
      await tab.locator('iframe').scrollIntoViewIfNeeded();
      await expect.poll(async () => Math.min(...(await times()))).toBeGreaterThan(0.1);
    },
  ));

if (spawnSync('python3', ['--version']).status === 0) {
  it('the example of a notebook: its cell plays a take', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'marrow-notebook-'));
    try {
      mkdirSync(join(folder, 'IPython'));
      writeFileSync(join(folder, 'IPython/__init__.py'), '');
      writeFileSync(join(folder, 'IPython/display.py'), 'HTML = str\n');
      const cell = `${readFileSync(join(CODE, 'notebook.py'), 'utf8')}
VIEWER = '/marrow-viewer.js'
print(show('walker.skel', 'walker.skin', 'walker_walk.anim'))
`;
      writeFileSync(join(folder, 'cell.py'), cell);
      const env = { ...process.env, PYTHONPATH: folder };
      const html = execFileSync('python3', [join(folder, 'cell.py')], { cwd: SAMPLES, env, encoding: 'utf8' });
      await onServer(`<!doctype html>${html}`, 'notebook.html', async (times) => {
        await expect.poll(async () => (await times())[0] ?? 0).toBeGreaterThan(0.1);
      });
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
  });
}
