/**
 * Mouse, keys and touch at random over the whole page, with real files: then everything is undone, and done again.
 *
 * Each round is a page of its own, with a seed of its own: `--seed` of one that failed repeats it. Since the page's own
 * timing is no part of a seed, its events are kept too, for `--replay`.
 */
import type { Page } from 'playwright-core';
import { dropFiles, withPage } from '../../helpers/page.ts';
import { type Attack, type Attempt, chanceOf } from '../attack.ts';
import { nextAct, type Size } from './walk/choose.ts';
import { controlsOf } from './walk/controls.ts';
import { differenceOf, filesOf } from './walk/documents.ts';
import { Hand, type WalkEvent } from './walk/events.ts';
import { DROPS, filesIn } from './walk/given.ts';

/** Small ones twice: they are drawn faster. */
const SIZES: readonly Size[] = [
  { width: 640, height: 480 },
  { width: 800, height: 560 },
  { width: 1280, height: 800 },
  { width: 800, height: 500 },
  { width: 1024, height: 640 },
  { width: 420, height: 700 },
];
const ACTS_PER_ROUND = 2500;
/** Between two looks at what the page offers. */
const BATCH = 40;
/** A page that takes longer for a batch, or for all of its round, hangs. */
const MAX_BATCH_MS = 60_000;
const MAX_ROUND_MS = 600_000;
/** What a page that is driven at random can be refused, and what the browser says of sliders under a touch that scrolls. */
const EXPECTED = /net::ERR_ABORTED|Context Lost|Ignored attempt to cancel a touchmove/;

/** A walk as it is kept. */
interface Walk {
  readonly seed: number;
  readonly events: readonly WalkEvent[];
}

export const randomWalk: Attack = {
  name: 'random-walk',
  shows: 'no error that nobody caught, undo back to the very bytes, and redo to those before',
  async run(attempt) {
    // Kept by an earlier run of this attack.
    const kept = attempt.replay === undefined ? undefined : (JSON.parse(attempt.replay) as Walk);
    let [rounds, inputs, steps, slowestMs] = [0, 0, 0, 0];
    const kinds = new Set<string>();
    // Each in a page of its own: one that has opened everything is slow.
    do {
      const seed = kept?.seed ?? attempt.seed + rounds;
      rounds++;
      const done: WalkEvent[] = [];
      const tell = (what: string) => {
        const content = JSON.stringify({ seed, problem: what, events: done } satisfies Walk & { problem: string });
        attempt.gaveWay(`seed ${seed}: ${what}`, { extension: 'json', content });
      };
      try {
        const walking = walk({ seed, done, events: kept?.events, tried: attempt.tried, tell });
        const walked = await inTime(walking, MAX_ROUND_MS);
        inputs += walked.inputs;
        steps += walked.labels.length;
        // Without names and numbers.
        for (const label of walked.labels) kinds.add(label.split(' ').slice(0, 2).join(' '));
        console.log(`  seed ${seed}: ${walked.inputs} inputs, ${walked.labels.length} steps`);
        slowestMs = Math.max(slowestMs, walked.slowestMs);
      } catch (error) {
        tell(error instanceof Error ? error.message : String(error));
      }
    } while (!kept && attempt.goesOn());
    attempt.note(`${rounds} pages, ${inputs} inputs, ${steps} steps of ${kinds.size} kinds undone and redone`);
    attempt.note(`slowest ${BATCH} acts ${Math.round(slowestMs)} ms`);
  },
};

interface Round extends Pick<Attempt, 'tried'> {
  readonly seed: number;
  /** Instead of chance. */
  readonly events: readonly WalkEvent[] | undefined;
  /** Filled with what was done. */
  readonly done: WalkEvent[];
  tell(what: string): void;
}

interface Walked {
  /** Messages to the browser. */
  readonly inputs: number;
  /** Of the steps that were undone at the end. */
  readonly labels: readonly string[];
  readonly slowestMs: number;
}

async function walk({ seed, events, done, tried, tell }: Round): Promise<Walked> {
  const chance = chanceOf(seed);
  const { random } = chance;
  const size = SIZES[chance.below(SIZES.length)];
  const touch = random() < 0.5;
  const colorScheme = random() < 0.5 ? 'light' : 'dark';
  const drop = chance.below(DROPS.length);
  let walked: Walked = { inputs: 0, labels: [], slowestMs: 0 };
  await withPage(
    async ({ page, problems }) => {
      await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
      page.on('filechooser', () => undefined);
      page.on('popup', (popup) => void popup.close().catch(() => undefined));
      page.on('dialog', (dialog) => void dialog.accept().catch(() => undefined));
      await page.waitForFunction(() => window.marrow?.characters().length);
      const opening = await filesOf(page);
      if (DROPS[drop].length > 0) {
        await dropFiles(page, filesIn(DROPS[drop]));
        await page.waitForFunction(() => window.marrow.steps().undo);
      }
      await quiet(page);
      const begun = await filesOf(page);
      // Those of the drop. Undone here, they are compared from the start.
      const first = await undoAll(page);
      await redo(page, first.length);

      const hand = new Hand(await page.context().newCDPSession(page));
      await hand.prepare();
      let slowestMs = 0;
      const acts = events ? 0 : ACTS_PER_ROUND;
      const left = [...(events ?? [])];
      for (let act = 0; act < acts || left.length > 0; act += BATCH) {
        const batch = left.splice(0, BATCH);
        if (!events) {
          const controls = await controlsOf(page);
          for (let i = 0; i < BATCH; i++)
            batch.push(...nextAct({ controls, size, hasTouch: touch, drops: DROPS.length }, chance));
        }
        done.push(...batch);
        const begunMs = performance.now();
        const sent = batch.map((event) =>
          event.kind === 'drop' ? dropFiles(page, filesIn(DROPS[event.drop])) : hand.do(event),
        );
        await inTime(Promise.all(sent), MAX_BATCH_MS);
        slowestMs = Math.max(slowestMs, performance.now() - begunMs);
        tried(BATCH);
        const found = problems.find((problem) => !EXPECTED.test(problem));
        // With the page's stack; the page's own complaint says the same.
        if (found !== undefined) throw new Error(found);
      }

      await hand.release();
      for (let i = 0; i < 6; i++) await page.keyboard.press('Escape');
      await quiet(page);
      const ended = await filesOf(page);
      const steps = await undoAll(page);
      walked = { inputs: hand.inputs, labels: steps, slowestMs };
      const told = (what: string, difference: string | undefined) => {
        if (difference !== undefined) tell(`${what}: ${difference}`);
      };
      told('undo of everything', differenceOf(opening, await filesOf(page)));
      const again = Math.min(first.length, steps.length);
      await redo(page, again);
      // A walk that has undone the drop itself has begun anew.
      const isWhole = first.every((label, i) => steps[steps.length - first.length + i] === label);
      if (isWhole) told('undo back to the files', differenceOf(begun, await filesOf(page)));
      // No further than to the end of the walk, which may have undone more.
      await redo(page, steps.length - again);
      told('redo of everything', differenceOf(ended, await filesOf(page)));
    },
    { walking: true, drawn: true, touch, size, colorScheme, expected: EXPECTED, before: prepare },
  );
  return walked;
}

/** Runs in the page before its scripts. */
function prepare(): void {
  // Dialogs of the system, which nobody would close, and a print preview.
  for (const name of ['showSaveFilePicker', 'showOpenFilePicker', 'showDirectoryPicker']) {
    Object.defineProperty(window, name, { value: undefined });
  }
  window.print = () => undefined;
  // Drawn in software, frames would take most of the time: events need but a few between them.
  const frame = window.requestAnimationFrame.bind(window);
  const FRAME_MS = 120;
  const frames = new Map<number, number>();
  window.requestAnimationFrame = (draw) => {
    const timer = window.setTimeout(() => {
      const drawing = frame((nowMs) => {
        frames.delete(timer);
        draw(nowMs);
      });
      frames.set(timer, drawing);
    }, FRAME_MS);
    return timer;
  };
  const cancelFrame = window.cancelAnimationFrame.bind(window);
  window.cancelAnimationFrame = (timer) => {
    clearTimeout(timer);
    cancelFrame(frames.get(timer) ?? 0);
  };
  const settings = { firstSteps: false, display: { shadow: false }, undoMegabytes: 4000 };
  localStorage.setItem('marrow.settings', JSON.stringify(settings));
}

function inTime<T>(work: Promise<T>, mostMs: number): Promise<T> {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => reject(new Error(`The page hangs: it took ${mostMs} ms.`)), mostMs);
  });
  return Promise.race([work, late]).finally(() => clearTimeout(timer));
}

/** Nothing plays, and what was begun has ended: reading, solving, computing. */
async function quiet(page: Page): Promise<void> {
  await page.evaluate(async () => {
    window.marrow.pause();
    const state = () => JSON.stringify([window.marrow.steps(), window.marrow.characters()]);
    let [last, same] = [state(), 0];
    for (let looks = 0; same < 4 && looks < 100; looks++) {
      await new Promise((resolve) => setTimeout(resolve, 150));
      const now = state();
      same = now === last ? same + 1 : 0;
      last = now;
    }
  });
}

/** Returns the labels of the steps, in the order in which they were undone. */
const undoAll = (page: Page): Promise<string[]> =>
  page.evaluate(() => {
    const labels: string[] = [];
    for (;;) {
      const label = window.marrow.steps().undo;
      if (!window.marrow.undo()) return labels;
      labels.push(label ?? '');
    }
  });

const redo = (page: Page, count: number) =>
  page.evaluate((most) => {
    for (let i = 0; i < most && window.marrow.redo(); i++);
  }, count);
