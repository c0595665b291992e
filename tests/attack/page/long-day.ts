/**
 * Eight hours of use in short, in one page: files are opened and removed, values are edited and undone, and takes are
 * played, by frames that this gives the page instead of the screen.
 */
import type { Page } from 'playwright-core';
import { withPage } from '../../helpers/page.ts';
import {
  changeText,
  countResources,
  grownPast,
  type PageResources,
  resourcesOf,
} from '../../helpers/page-resources.ts';
import type { Attack } from '../attack.ts';
import { openWalker } from './open-close.ts';
import { captureOf } from './sample-files.ts';

/** A day, in parts that have all of it. */
const PARTS = 20;
const FILES = 2000;
const EDITS = 10_000;
const PLAYED_SECONDS = 3600;
/** Ten times as fast as they are taken, at 30 frames per second. */
const FRAME_SECONDS = 10 / 30;
/** Until then caches fill, and undo what it may keep. */
const WARM_UP = 6;
/** What a day may leave: what comes and goes with messages and tooltips, and chance. */
const MAX_LEFT: Partial<PageResources> = {
  heapBytes: 500_000,
  nodes: 200,
  listeners: 100,
  geometries: 5,
  textures: 5,
  gpuObjects: 20,
  objectUrls: 5,
  observers: 5,
};

declare global {
  interface Window {
    /** Set by `takeFrames`: runs one frame, that many milliseconds after the last one; absent: the browser's own. */
    giveFrame?: (elapsedMs: number) => void;
    framesAreGiven?: boolean;
  }
}

export const longDay: Attack = {
  name: 'long-day',
  shows:
    'heap, nodes, listeners, GPU objects, object URLs and observers level over 2,000 files, 10,000 edits and an hour played at 10 ×',
  async run(attempt) {
    await withPage(
      async ({ page }) => {
        await openWalker(page);
        let before: PageResources | undefined;
        let [part, steps] = [0, 0];
        for (; part < PARTS && attempt.goesOn(); part++) {
          if (part === WARM_UP) before = await resourcesOf(page);
          steps += await openAndRemove(page, FILES / PARTS);
          await editAndUndo(page, EDITS / PARTS);
          await playOn(page, PLAYED_SECONDS / PARTS);
          attempt.tried();
        }
        const share = part / PARTS;
        attempt.note(`${share * FILES} files, ${share * EDITS} edits, ${share * PLAYED_SECONDS} s played`);
        if (!before) return;
        const after = await resourcesOf(page);
        attempt.note(`from part ${WARM_UP} on ${changeText(before, after)}`);
        for (const what of grownPast(MAX_LEFT, before, after)) attempt.gaveWay(what);
        const undone = await undoAll(page);
        attempt.note(`undo keeps ${undone} of ${steps} steps`);
        // Else what it grows by would be in what is compared.
        if (undone >= (steps * WARM_UP) / part) attempt.gaveWay('undo was not full after the first parts');
      },
      { size: { width: 640, height: 480 }, drawn: true, before: [countResources, prepare] },
    );
  },
};

const CAPTURE = captureOf(300);

/**
 * In turns a capture of ten seconds, and a skeleton with its take. Each is opened, shown and removed. Returns the
 * number of steps that this made.
 */
function openAndRemove(page: Page, count: number): Promise<number> {
  return page.evaluate(
    async ([files, capture]) => {
      const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
      let opened = 0;
      let steps = 0;
      for (let i = 0; opened < files; i++) {
        const name = `file${i % 10}`;
        const skel = `balljoint ${name} { boxmin 0 0 0 boxmax 1 3 1 balljoint top { offset 0 3 0 } }`;
        const given =
          i % 2 === 0
            ? [{ name: `${name}.bvh`, content: capture }]
            : [
                { name: `${name}.skel`, content: skel },
                { name: `${name}.anim`, content: 'animation { range 0 1 numchannels 0 }' },
              ];
        await window.marrow.open(given);
        opened += given.length;
        steps += 2;
        await frame();
        for (const { id, name: own } of window.marrow.characters()) {
          if (own !== 'walker') await window.marrow.run('character.remove', { characterId: id });
        }
      }
      const left = window.marrow.characters().map(({ name }) => name);
      if (left.join() !== 'walker') throw new Error(`After all files were removed there are ${left.join()}.`);
      return steps;
    },
    [count, CAPTURE] as const,
  );
}

/** Returns the number of steps. */
function undoAll(page: Page): Promise<number> {
  return page.evaluate(() => {
    let steps = 0;
    for (; window.marrow.steps().undo !== undefined; steps++) window.marrow.undo();
    return steps;
  });
}

function editAndUndo(page: Page, count: number): Promise<void> {
  return page.evaluate(async (edits) => {
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    const before = window.marrow.steps().undo;
    for (let i = 0; i < edits; i++) {
      await window.marrow.run('pose.setDofs', { dofs: [{ index: 3 + (i % 20), value: (i % 50) / 100 }] });
      if (i % 3 === 0) await window.marrow.run('pose.key', { timeSeconds: (i % 40) / 10 });
      if (i % 20 === 0) await frame();
      // A value that it has already is no step.
      while (window.marrow.steps().undo !== before) window.marrow.undo();
    }
  }, count);
}

/** Whole rounds of the take, at ten times its speed. */
function playOn(page: Page, seconds: number): Promise<void> {
  return page.evaluate(
    async ([played, frameSeconds]) => {
      window.framesAreGiven = true;
      window.marrow.play();
      for (let t = 0; t < played; t += frameSeconds) {
        window.giveFrame?.(1000 * frameSeconds);
        // What waits for a turn of its own has it.
        if (Math.round(t / frameSeconds) % 10 === 0) await new Promise((resolve) => setTimeout(resolve));
      }
      window.marrow.pause();
      window.giveFrame?.(1);
      window.framesAreGiven = false;
    },
    [seconds, FRAME_SECONDS] as const,
  );
}

/** Runs in the page before its scripts. */
function prepare(): void {
  let waiting: FrameRequestCallback[] = [];
  let nowMs = performance.now();
  const frame = window.requestAnimationFrame.bind(window);
  // Ids are only given back to the browser, which knows none of these.
  window.requestAnimationFrame = (work) => (window.framesAreGiven ? -waiting.push(work) : frame(work));
  window.giveFrame = (elapsedMs) => {
    nowMs += elapsedMs;
    const due = waiting;
    waiting = [];
    for (const work of due) work(nowMs);
  };
  // So little undo that a few parts of the day fill it: what grows from then on is none of its.
  const settings = { firstSteps: false, display: { shadow: false }, undoMegabytes: 1 };
  localStorage.setItem('marrow.settings', JSON.stringify(settings));
}
