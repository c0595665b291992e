/**
 * A skin of a million vertices with three morphs (some 215 MB of text), dropped on the built page: time from the drop
 * to the document and to the first frame, and every script task on the main thread over 50 ms (there should be none).
 * Drawing is not script: without a GPU it is done by the CPU, in the browser's own process, and only the calls count
 * here.
 */
import { closeSync, existsSync, mkdtempSync, openSync, rmSync, writeSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, bench, describe } from 'vitest';
import { dropPaths, withPage } from '../helpers/page.ts';

const AROUND = 1000;
const ALONG = 1000;
const JOINTS = 10;
const MORPHS = 3;
const HEIGHT = 4;

const folder = mkdtempSync(join(tmpdir(), 'marrow-bench-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

/** Writes a file row by row of the tube, without a string of its whole content. */
function write(name: string, blocks: (put: (text: string) => void) => void): string {
  const path = join(folder, name);
  const file = openSync(path, 'w');
  blocks((text) => writeSync(file, text));
  closeSync(file);
  return path;
}

function rows(
  put: (text: string) => void,
  head: string,
  count: number,
  row: (along: number, around: number) => string,
) {
  put(`${head} ${count} {\n`);
  for (let v = 0; v < count / AROUND; v++) {
    let text = '';
    for (let u = 0; u < AROUND; u++) text += row(v, u);
    put(text);
  }
  put('}\n');
}

const angle = (u: number) => (2 * Math.PI * u) / AROUND;
const point = (v: number, u: number, radius: number) =>
  `${(radius * Math.cos(angle(u))).toFixed(6)} ${((v / ALONG) * HEIGHT).toFixed(6)} ${(radius * Math.sin(angle(u))).toFixed(6)}`;

function tube(): string[] {
  const vertices = AROUND * ALONG;
  const skel = write('tube.skel', (put) => {
    for (let j = 0; j < JOINTS; j++) put(`balljoint j${j} { offset 0 ${j ? HEIGHT / JOINTS : 0} 0\n`);
    put('}'.repeat(JOINTS));
  });
  const skin = write('tube.skin', (put) => {
    rows(put, 'positions', vertices, (v, u) => `${point(v, u, 0.3)}\n`);
    rows(put, 'normals', vertices, (_v, u) => `${Math.cos(angle(u)).toFixed(6)} 0 ${Math.sin(angle(u)).toFixed(6)}\n`);
    rows(put, 'skinweights', vertices, (v) => {
      const at = (v / ALONG) * (JOINTS - 1);
      const j = Math.min(JOINTS - 2, Math.floor(at));
      return `2 ${j} ${(1 - at + j).toFixed(4)} ${j + 1} ${(at - j).toFixed(4)}\n`;
    });
    put(`triangles ${2 * AROUND * (ALONG - 1)} {\n`);
    for (let v = 0; v < ALONG - 1; v++) {
      let text = '';
      for (let u = 0; u < AROUND; u++) {
        const a = v * AROUND + u;
        const b = v * AROUND + ((u + 1) % AROUND);
        text += `${a} ${a + AROUND} ${b}\n${b} ${a + AROUND} ${b + AROUND}\n`;
      }
      put(text);
    }
    put(`}\nbindings ${JOINTS} {\n`);
    for (let j = 0; j < JOINTS; j++) put(`matrix { 1 0 0 0 1 0 0 0 1 0 ${(j * HEIGHT) / JOINTS} 0 }\n`);
    put('}\n');
  });
  const morphs = Array.from({ length: MORPHS }, (_, m) =>
    write(`tube_${m}.morph`, (put) => {
      rows(put, 'positions', vertices, (v, u) => `${v * AROUND + u} ${point(v, u, 0.35 + 0.05 * m)}\n`);
      put('normals 0 { }\n');
    }),
  );
  return [skel, skin, ...morphs];
}

describe('a million vertices and three morphs, dropped on the page', () => {
  bench(
    'from the drop to the first picture',
    async () => {
      if (!existsSync('dist/index.html')) throw new Error('There is no built page: "npm run build" first.');
      const paths = tube();
      await withPage(
        async ({ page }) => {
          await page.waitForFunction(() => window.marrow?.characters().length);
          await page.evaluate(() => {
            window.marrow.pause();
            const seen = Object.assign(window, { longTasks: [] as number[], dropped: performance.now() });
            new PerformanceObserver((list) => {
              for (const entry of list.getEntries()) seen.longTasks.push(Math.round(entry.duration));
            }).observe({ type: 'longtask' });
          });
          await dropPaths(page, paths);
          await page.waitForFunction(() => window.marrow.characters().some((c) => c.name === 'tube'));
          const document = await page.evaluate(() => performance.now() - Reflect.get(window, 'dropped'));
          const shown = () => page.evaluate(() => window.marrow.stats().triangles);
          while ((await shown()) < 1_000_000) await page.evaluate(() => new Promise(requestAnimationFrame));
          const result = await page.evaluate(() => ({
            picture: performance.now() - Reflect.get(window, 'dropped'),
            longTasks: Reflect.get(window, 'longTasks'),
          }));
          console.log(
            `document after ${document.toFixed(0)} ms, picture after ${result.picture.toFixed(0)} ms (drawn by the ` +
              `processor where there is no GPU); script tasks over 50 ms: ${result.longTasks.join(', ') || 'none'}`,
          );
        },
        { drawn: true },
      );
    },
    { iterations: 1, time: 0, warmupIterations: 0, warmupTime: 0 },
  );
});
