/**
 * Files at the ends of what formats allow are dropped and looked at in every panel: each opens or is refused in words,
 * without a long task, and everything is undone.
 */
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { tasksOf } from '../../helpers/main-thread.ts';
import { dropPaths, withPage } from '../../helpers/page.ts';
import type { Attack, Attempt } from '../attack.ts';
import { EXTREMES, type Extreme } from './extreme-files.ts';

/** CPU time of the main thread in one task; ms. */
const MAX_TASK_MS = 200;
/** Of the page's process at its largest, beside ten times the files. */
const MAX_PEAK_BYTES = 1.2e9;
/** A page that doesn't answer for longer is dead; ms. */
const DEAD_MS = 120_000;

export const extremes: Attack = {
  name: 'extremes',
  shows: `files with extreme numbers, counts and names open or are refused in words, without a task over ${MAX_TASK_MS} ms`,
  async run(attempt) {
    const folder = mkdtempSync(join(tmpdir(), 'marrow-extremes-'));
    let longest = { ms: 0, what: '' };
    try {
      for (let i = 0; attempt.goesOn(); i++) {
        const extreme = EXTREMES[i % EXTREMES.length];
        const ms = await tryOne(attempt, extreme, join(folder, String(i)));
        if (ms > longest.ms) longest = { ms, what: extreme.name };
        rmSync(join(folder, String(i)), { recursive: true, force: true });
        attempt.tried();
      }
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
    attempt.note(`longest task ${Math.round(longest.ms)} ms (${longest.what})`);
  },
};

/** Returns the longest task. */
async function tryOne(attempt: Attempt, extreme: Extreme, folder: string): Promise<number> {
  mkdirSync(folder);
  const files = extreme.files(attempt);
  const paths = files.map(({ name, bytes }) => {
    const path = join(folder, name);
    writeFileSync(path, bytes);
    return path;
  });
  const size = files.reduce((sum, { bytes }) => sum + bytes.length, 0);
  let longest = 0;
  let step = 'opening the page';
  try {
    await withPage(
      async ({ page }) => {
        page.setDefaultTimeout(DEAD_MS);
        await page.waitForFunction(() => window.marrow?.characters().length);
        const doing = async (name: string, act: () => Promise<unknown>) => {
          step = name;
          const [task] = await tasksOf(page, () => alive(act()));
          if (task && task.ms > longest) longest = task.ms;
          if (task && task.ms > MAX_TASK_MS)
            attempt.gaveWay(`${extreme.name}: ${name} took a task of ${Math.round(task.ms)} ms: ${task.what}`);
        };
        const before = await documentOf(page);
        await doing('opening', async () => {
          await dropPaths(page, paths);
          await drawn(page);
        });
        const opened = await documentOf(page);
        const said = await page.locator('.message-line').textContent();
        const isOpen = opened !== before || (await page.locator('.review-count').count()) > 0;
        if (!isOpen && !said) attempt.gaveWay(`${extreme.name}: neither opened nor refused in words`, kept(files));
        if (extreme.opens !== undefined && extreme.opens !== isOpen)
          attempt.gaveWay(`${extreme.name}: ${isOpen ? 'opened' : `not opened: ${said}`}`, kept(files));
        await lookAround(page, doing);
        await doing('undoing', async () => {
          await page.evaluate(() => {
            while (window.marrow.undo());
          });
          await drawn(page);
        });
        if ((await documentOf(page)) !== before)
          attempt.gaveWay(`${extreme.name}: undo does not lead back`, kept(files));
        const peak = await peakOf(page);
        if (peak > MAX_PEAK_BYTES + 10 * size)
          attempt.gaveWay(`${extreme.name}: ${Math.round(peak / 1e6)} MB of memory for ${Math.round(size / 1e6)} MB`);
      },
      { size: { width: 1280, height: 800 }, drawn: true },
    );
  } catch (error) {
    attempt.gaveWay(`${extreme.name}: ${step}: ${error instanceof Error ? error.message : error}`, kept(files));
  }
  return longest;
}

/** A single text is kept as it is. */
function kept(files: readonly { readonly name: string; readonly bytes: Uint8Array | string }[]) {
  const [first] = files;
  if (files.length > 2 || first.bytes.length > 100_000) return undefined;
  return { extension: first.name.replace(/.*\./, ''), content: first.bytes };
}

type Doing = (name: string, act: () => Promise<unknown>) => Promise<void>;

/** What a person does with what was opened. */
async function lookAround(page: Page, doing: Doing): Promise<void> {
  const run = (id: string) =>
    page.evaluate(async (action) => {
      // What can't be done here is refused in words.
      await Promise.resolve(window.marrow.run(action)).catch(() => undefined);
    }, id);
  await doing('selecting a joint', async () => {
    const joint = page.locator('[role=treeitem].row-joint');
    if ((await joint.count()) > 0) await joint.nth(Math.min(1, (await joint.count()) - 1)).click();
    await drawn(page);
  });
  for (const name of ['curves', 'dope', 'takes', 'measure', 'poses', 'steps', 'source']) {
    await doing(`the tab ${name}`, async () => {
      const tab = page.locator(`#timeline-tab-${name}`);
      if ((await tab.count()) > 0 && (await tab.isVisible())) await tab.click();
      await drawn(page);
    });
  }
  for (const action of [
    'view.ghosts',
    'draw.trail',
    'draw.names',
    'draw.axes',
    'view.frameAll',
    'view.frameSelection',
  ]) {
    await doing(action, async () => {
      await run(action);
      await drawn(page);
    });
  }
  await doing('the end of the range, and some frames played', async () => {
    await page.locator('.viewport').focus();
    await page.keyboard.press('End');
    await drawn(page);
    await page.evaluate(() => window.marrow.play());
    for (let i = 0; i < 5; i++) await drawn(page);
    await page.evaluate(() => window.marrow.pause());
  });
  for (const title of ['Save', 'Edit', 'Keys']) {
    await doing(`the menu ${title}`, async () => {
      await page.getByRole('menuitem', { name: title, exact: true }).click();
      await drawn(page);
      await page.keyboard.press('Escape');
      await page.keyboard.press('Escape');
    });
  }
  await doing('searching', async () => {
    await page.getByRole('searchbox').first().fill('j1');
    await drawn(page);
    await page.getByRole('searchbox').first().fill('');
    await drawn(page);
  });
}

async function alive<T>(work: Promise<T>): Promise<T> {
  let timer: NodeJS.Timeout | undefined;
  const dead = new Promise<never>((_, fail) => {
    timer = setTimeout(() => fail(new Error(`the page did not answer for ${DEAD_MS / 1000} s`)), DEAD_MS);
  });
  try {
    return await Promise.race([work, dead]);
  } finally {
    clearTimeout(timer);
  }
}

/** All that was dropped is read, and two frames have passed. */
const drawn = (page: Page) =>
  page.evaluate(async () => {
    await window.marrow.open([]);
    await new Promise<void>((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(resolve))));
  });

const documentOf = (page: Page) =>
  page.evaluate(() =>
    window.marrow
      .characters()
      .map((c) => [c.id, c.joints.length, c.skins.length, c.morphs.length, c.takes.length, c.vertexCount].join())
      .join(';'),
  );

/** The largest that a page's process has been, in bytes; 0 where the system doesn't tell. */
async function peakOf(page: Page): Promise<number> {
  const session = await page.context().browser()?.newBrowserCDPSession();
  if (!session || !existsSync('/proc')) return 0;
  const { processInfo } = await session.send('SystemInfo.getProcessInfo');
  await session.detach();
  const peaks = processInfo.filter(({ type }) => type === 'renderer').map(({ id }) => peakOfProcess(id));
  return Math.max(0, ...peaks);
}

function peakOfProcess(pid: number): number {
  try {
    return 1024 * Number(/VmHWM:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))?.[1] ?? 0);
  } catch {
    // It has ended.
    return 0;
  }
}
