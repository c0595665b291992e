/**
 * Folders of many files, dropped on the built page: time from the drop to the document and to the first frame with it,
 * and every task on the main thread that it worked in for more than 50 ms. Without a GPU the frame is drawn by the
 * processor, which most of the second time is then.
 */
import { existsSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, bench, describe } from 'vitest';
import { walkerFiles } from '../helpers/hero.ts';
import { tasksOf } from '../helpers/main-thread.ts';
import { dropPaths, withPage } from '../helpers/page.ts';

const JOINTS = 20;
/** Of each channel of a take, which has 97 kB. */
const KEYS = 45;

const folder = mkdtempSync(join(tmpdir(), 'marrow-bench-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const number = (i: number) => (30 * Math.sin(0.1 * i)).toFixed(6);
const numbers = (count: number, seed: number) => Array.from({ length: count }, (_, i) => number(31 * i + seed));

function anim(seed: number): string {
  const channels = Array.from({ length: 3 + 3 * JOINTS }, (_, c) => {
    const keys = numbers(KEYS, c + seed).map((value, k) => `${(k / 30).toFixed(6)} ${value} smooth smooth`);
    return `channel {\nextrapolate constant constant\nkeys ${KEYS} {\n${keys.join('\n')}\n}\n}`;
  });
  return `animation {\nrange 0 ${KEYS / 30}\nnumchannels ${channels.length}\n${channels.join('\n')}\n}\n`;
}

const skel =
  Array.from({ length: JOINTS }, (_, j) => `balljoint j${j} { offset 0 0.1 0`).join('\n') + '}'.repeat(JOINTS);
const takes = () => Array.from({ length: 1000 }, (_, i) => ({ path: `take_${i}.anim`, blob: new Blob([anim(i)]) }));

const FOLDERS = [
  { name: '100 characters of seven files', make: () => walkerFiles(100), characters: 100 },
  { name: '1,000 takes', make: () => [{ path: 'take.skel', blob: new Blob([skel]) }, ...takes()], characters: 1 },
];

for (const { name, make, characters } of FOLDERS) {
  describe(`${name}, dropped on the page`, () => {
    bench(
      'from the drop to the first picture',
      async () => {
        if (!existsSync('dist/index.html')) throw new Error('There is no built page: "npm run build" first.');
        const path = join(folder, name.replaceAll(/\W+/g, '-'));
        mkdirSync(path, { recursive: true });
        for (const file of make()) writeFileSync(join(path, file.path), new Uint8Array(await file.blob.arrayBuffer()));
        await withPage(
          async ({ page }) => {
            await page.waitForFunction(() => window.marrow?.characters().length);
            await page.evaluate(() => window.marrow.pause());
            const before = await page.evaluate(() => window.marrow.characters()[0]?.id);
            let times: readonly number[] = [];
            const tasks = await tasksOf(page, async () => {
              const begun = performance.now();
              await dropPaths(page, [path]);
              await page.waitForFunction(
                ([count, old]) =>
                  window.marrow.characters().length === count && window.marrow.characters()[0]?.id !== old,
                [characters, before] as const,
                { polling: 10, timeout: 60_000 },
              );
              const opened = performance.now() - begun;
              await page.evaluate(
                () => new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next))),
              );
              times = [opened, performance.now() - begun];
            });
            const long = tasks.filter(({ ms }) => ms > 50).map(({ ms }) => Math.round(ms));
            console.log(
              `${name}: open after ${times[0].toFixed(0)} ms, picture after ${times[1].toFixed(0)} ms; tasks of over 50 ms ` +
                `of CPU time: ${long.join(', ') || 'none'}`,
            );
          },
          { drawn: true },
        );
      },
      { iterations: 1, time: 0, warmupIterations: 0, warmupTime: 0 },
    );
  });
}
