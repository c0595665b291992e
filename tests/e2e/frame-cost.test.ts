/** What a frame asks of the GPU, in characters that are the same on any machine. */
import { readFileSync } from 'node:fs';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { countGlCalls, framesWhile, nextFrames, usual } from '../helpers/gl-calls.ts';
import { withPage } from '../helpers/page.ts';

const WALKER = ['.rig', '.skel', '.skin', '_blink.morph', '_breathe.morph', '_smile.morph', '_walk.anim'];
const sample = (end: string) => readFileSync(new URL(`../../public/samples/walker${end}`, import.meta.url), 'utf8');

/** Frames that are looked at. */
const FRAMES = 5;
const OPTIONS = { walking: true, fullMotion: true, firstVisit: true, before: countGlCalls } as const;
const SIZE = { width: 800, height: 600 };

/** Opens walkers from files of their own: all equal, or each with a vertex of its own. */
async function openWalkers(page: Page, first: number, count: number, areEqual: boolean): Promise<void> {
  const files = Array.from({ length: count }, (_, i) => `w${first + i}`).flatMap((name, i) =>
    WALKER.map((end) => {
      const text = sample(end).replaceAll(/walker(?!\.png)/g, name);
      const moved = text.replace(
        /(positions \d+ \{\s*)(-?[\d.]+)/,
        (_, before, x) => `${before}${Number(x) + i / 1000}`,
      );
      return { name: `${name}${end}`, content: end === '.skin' && !areEqual ? moved : text };
    }),
  );
  await page.evaluate(async (all) => {
    await window.marrow.open(all);
    await window.marrow.run('view.frameAll');
  }, files);
  await page.waitForFunction((n) => window.marrow.characters().length >= n, count);
}

const playing = async (page: Page) => usual(await nextFrames(page, FRAMES));

/** Resolves once nothing was drawn in so many of the screen's frames in a row. */
const untilStill = (page: Page) =>
  page.evaluate(
    () =>
      new Promise<void>((resolve) => {
        let drawn = -1;
        let still = 0;
        const look = () => {
          const now = window.glFrames?.length ?? 0;
          still = now === drawn ? still + 1 : 0;
          drawn = now;
          if (still < 60) requestAnimationFrame(look);
          else resolve();
        };
        look();
      }),
  );

describe('a frame', () => {
  it('of equal characters asks as much of the GPU as that of one: one upload and one draw, and one for the shadow', () =>
    withPage(
      async ({ page }) => {
        await page.evaluate(() => window.marrow.play());
        const one = await playing(page);
        await openWalkers(page, 0, 10, true);
        const ten = await playing(page);
        await openWalkers(page, 10, 20, true);
        const thirty = await playing(page);
        expect(ten.calls).toBeLessThanOrEqual(75);
        expect(thirty).toMatchObject({ calls: ten.calls, draws: ten.draws, uploads: ten.uploads });
        expect(ten.draws).toBeLessThanOrEqual(one.draws);
        // The palette grows by doubling.
        expect(thirty.uploadedBytes).toBeLessThanOrEqual(31 * 2 * 4096);

        // As many again that differ.
        await openWalkers(page, 30, 10, false);
        const unequal = await playing(page);
        expect((unequal.calls - thirty.calls) / 10).toBeLessThanOrEqual(8);
        expect(unequal.uploads).toBe(thirty.uploads);
      },
      { ...OPTIONS, size: SIZE },
    ));

  it('is none while nothing plays or moves', () =>
    withPage(
      async ({ page }) => {
        await page.evaluate(() => window.marrow.pause());
        await untilStill(page);
      },
      { ...OPTIONS, size: SIZE },
    ));

  it('in which only the camera moves uploads no pose and draws no shadow', () =>
    withPage(
      async ({ page }) => {
        await page.evaluate(() => window.marrow.pause());
        await untilStill(page);
        let seconds = 0.5;
        const moving = usual(
          await framesWhile(page, FRAMES, () => {
            seconds += 0.01;
            return page.evaluate((time) => window.marrow.seek(time), seconds);
          }),
        );
        const turning = usual(
          await framesWhile(page, FRAMES, () => page.evaluate(() => window.marrow.run('view.orbitLeft'))),
        );
        expect(turning.draws).toBe(moving.draws - 1);
        // Where the instances are, seen from the new place, and the grid's numbers.
        expect(turning.uploads).toBeLessThanOrEqual(2);
        expect(turning.uploadedBytes).toBeLessThanOrEqual(2 * 4096);
      },
      { ...OPTIONS, size: SIZE },
    ));

  it('of a large skin with many morphs uploads weights, not vertices', () =>
    withPage(
      async ({ page }) => {
        await page.evaluate(
          async (files) => {
            await window.marrow.open(files);
            window.marrow.play();
          },
          manyMorphs(30_000, 10),
        );
        await page.waitForFunction(() => window.marrow.characters().some(({ vertexCount }) => vertexCount === 30_000));
        // Until it is uploaded.
        await expect.poll(async () => (await playing(page)).uploadedBytes, { timeout: 60_000 }).toBeLessThan(10_000);
      },
      { ...OPTIONS, size: SIZE },
    ));
});

/** A skin on one joint, and morphs of all of its vertices with a take that moves their weights. */
function manyMorphs(vertices: number, morphs: number) {
  const rows = (at: (v: number) => string) => Array.from({ length: vertices }, (_, v) => at(v)).join('\n');
  const point = (v: number, lift: number) =>
    `${Math.cos(v).toFixed(4)} ${(v / vertices + lift).toFixed(4)} ${Math.sin(v).toFixed(4)}`;
  const skin = `positions ${vertices} {\n${rows((v) => point(v, 0))}\n}
normals ${vertices} {\n${rows(() => '0 1 0')}\n}
skinweights ${vertices} {\n${rows(() => '1 0 1')}\n}
triangles ${vertices - 2} {\n${Array.from({ length: vertices - 2 }, (_, v) => `${v} ${v + 1} ${v + 2}`).join('\n')}\n}
bindings 1 {\nmatrix {\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n}\n}\n`;
  const channel = (high: number) =>
    `channel { extrapolate cycle cycle keys 2 { 0 0 linear linear 1 ${high} linear linear } }`;
  const channels = [...Array(6).fill(channel(0)), ...Array(morphs).fill(channel(1))];
  return [
    { name: 'ball.skel', content: 'balljoint root { boxmin -1 0 -1 boxmax 1 1 1 }' },
    { name: 'ball.skin', content: skin },
    ...Array.from({ length: morphs }, (_, m) => ({
      name: `ball_${m}.morph`,
      content: `positions ${vertices} {\n${rows((v) => `${v} ${point(v, m / 10)}`)}\n}`,
    })),
    { name: 'ball.anim', content: `animation { range 0 1 numchannels ${channels.length}\n${channels.join('\n')}\n}` },
  ];
}
