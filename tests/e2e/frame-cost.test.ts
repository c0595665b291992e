/** What a frame asks of the GPU, in numbers that are the same on any machine. */
import type { Page } from 'playwright-core';
import { describe, expect } from 'vitest';
import type { GivenBlob } from '../../src/worker/protocol.ts';
import { capture } from '../bench/capture.ts';
import { star } from '../bench/gpu/scenes/star.ts';
import { countGlCalls, drawNothing, type FrameCalls, framesWhile, usual } from '../helpers/gl-calls.ts';
import { walkerFiles } from '../helpers/hero.ts';
import { manyMorphs } from '../helpers/many-morphs.ts';
import { inOnePage, undoAll } from '../helpers/one-page.ts';
import { openFiles } from '../helpers/page.ts';

/** Frames that are looked at, at times that are so many seconds apart. */
const FRAMES = 7;
const STEP = 0.01;
const OPTIONS = {
  walking: true,
  firstVisit: true,
  // What draws nothing fills no pixels either, and isn't counted.
  drawn: true,
  before: [drawNothing, countGlCalls],
  size: { width: 800, height: 600 },
} as const;

type Files = readonly GivenBlob[];

const textFile = (path: string, text: string): GivenBlob => ({ path, blob: new Blob([text]) });

/** Opens files beside what is there, paused. Resolves once nothing was drawn in 30 of the screen's frames in a row. */
async function open(page: Page, files: Files): Promise<void> {
  await openFiles(page, files);
  await page.evaluate(async () => {
    await window.marrow.run('view.frameAll');
    window.marrow.pause();
  });
  await page.evaluate(
    () =>
      new Promise<void>((resolve) => {
        let drawn = -1;
        let still = 0;
        const look = () => {
          const now = window.glFrames?.length ?? 0;
          still = now === drawn ? still + 1 : 0;
          drawn = now;
          if (still < 30) requestAnimationFrame(look);
          else resolve();
        };
        look();
      }),
  );
}

/** The usual frame of those in which time goes on: the same frames each time. */
async function moving(page: Page): Promise<FrameCalls> {
  let seconds = 0.5;
  const frames = await framesWhile(page, FRAMES, () => {
    seconds += STEP;
    return page.evaluate((time) => window.marrow.seek(time), seconds);
  });
  return usual(frames);
}

const CAPTURE = { joints: 70, frames: 120, frameSeconds: 1 / 120 };
const captures = (count: number): Files =>
  Array.from({ length: count }, (_, i) => textFile(`take${i}.bvh`, capture(i, CAPTURE).bvh));

/**
 * What is drawn, in the shadow and in the picture: skins in one call each for equal ones, or balls and bones in one
 * each; and the background, the floor, the grid and its numbers. What is uploaded: rows of the palette, or 32 bytes for
 * each joint and bone end; of the walker, which the camera follows, its place in the view too. In one page the palette
 * keeps the rows that it has grown to: characters that need most come last.
 */
const SCENES: readonly (readonly [what: string, files: () => Files, frame: FrameCalls])[] = [
  ['the walker', () => [], { calls: 78, draws: 6, uploads: 2, uploadedBytes: 8192 }],
  ['30 captures', () => captures(30), { calls: 58, draws: 7, uploads: 1, uploadedBytes: 100_800 }],
  [
    'a skin of 3,000 vertices with 10 morphs of all of them',
    () => manyMorphs(3000, 10),
    { calls: 67, draws: 6, uploads: 1, uploadedBytes: 4096 },
  ],
  [
    'a star of 2,000 joints',
    () => [textFile('star.bvh', star(2000))],
    { calls: 48, draws: 7, uploads: 1, uploadedBytes: 127_968 },
  ],
  ['30 walkers', () => walkerFiles(30), { calls: 67, draws: 6, uploads: 1, uploadedBytes: 65_536 }],
];

const inPage = inOnePage(OPTIONS);

describe('a frame', () => {
  inPage('in which only the camera moves uploads no pose and draws no shadow', async ({ page }) => {
    await undoAll(page);
    await open(page, []);
    const turning = async () => {
      const posed = await moving(page);
      const turn = () => page.evaluate(() => window.marrow.run('view.orbitLeft'));
      const { draws, uploads, uploadedBytes } = usual(await framesWhile(page, FRAMES, turn));
      return { undrawn: posed.draws - draws, uploads, uploadedBytes };
    };
    // Where the instances are, seen from the new place.
    await expect.poll(turning).toEqual({ undrawn: 1, uploads: 1, uploadedBytes: 4096 });
  });

  for (const [what, files, frame] of SCENES) {
    inPage(
      `of ${what} asks exactly this of the GPU while time goes on, and there is none when it stops`,
      async ({ page }) => {
        await undoAll(page);
        await open(page, files());
        // What the page loads when it is idle may still come, and is drawn once.
        await expect.poll(() => moving(page)).toEqual(frame);
      },
    );
  }

  inPage('of characters that differ has at most eight calls more for each, and as many uploads', async ({ page }) => {
    await undoAll(page);
    const files = await otherWalkers(6);
    await open(page, files.slice(0, 2 * FILES_EACH));
    const two = await moving(page);
    await open(page, files.slice(2 * FILES_EACH));
    const six = await moving(page);
    expect((six.calls - two.calls) / 4).toBeLessThanOrEqual(8);
    expect(six.uploads).toBe(two.uploads);
  });
});

/** Of a walker, without its picture. */
const FILES_EACH = 7;

/** Walkers of which each has a vertex of its own. */
async function otherWalkers(count: number): Promise<Files> {
  const files = walkerFiles(count).filter(({ path }) => !path.endsWith('.png'));
  return Promise.all(
    files.map(async ({ path, blob }, i) => {
      const text = (await blob.text()).replaceAll(/\bw(\d+)\b/g, 'other$1');
      const moved = text.replace(
        /(positions \d+ \{\s*)(-?[\d.]+)/,
        (_, before, x) => `${before}${Number(x) + i / 1000}`,
      );
      return textFile(path.replace(/^w/, 'other'), path.endsWith('.skin') ? moved : text);
    }),
  );
}
