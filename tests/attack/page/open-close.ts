/** Menus, dialogs, panels, tabs, modes and files are opened and closed again and again: what the page holds stays level. */
import type { Page } from 'playwright-core';
import { type DroppedFile, dropFiles, withPage } from '../../helpers/page.ts';
import {
  changeText,
  countResources,
  grownPast,
  type PageResources,
  resourcesOf,
} from '../../helpers/page-resources.ts';
import type { Attack } from '../attack.ts';
import { DROPS, WALKER_DROP } from './sample-files.ts';

/** Caches fill, and scripts are fetched. */
const WARM_UP = 3;
/** Items that open no dialog: the system asks, or a field in the page has the focus. */
const ASK_ELSEWHERE = /^(Open files|Open folder|Compare with your program|Rename take|Go to time)…/;
/** A few cycles prove nothing. */
const MIN_CYCLES = 5;
/** Growth for each cycle that isn't chance: tables of weak references double once in a while. */
const MAX_GROWTH: Partial<PageResources> = {
  heapBytes: 30_000,
  nodes: 5,
  listeners: 2,
  gpuObjects: 1,
  objectUrls: 0.2,
  observers: 0.5,
};
/** Each there and back. */
const TOGGLED = [
  'page.outliner',
  'page.inspector',
  'page.timeline',
  'rigging.mode',
  'posing.toggle',
  'posing.selectTool',
].flatMap((id) => [id, id]);

export const openClose: Attack = {
  name: 'open-close',
  shows:
    'heap, nodes, listeners, observers, object URLs and GPU objects stay level while menus, dialogs, panels, tabs, modes and files of all kinds are opened and closed',
  async run(attempt) {
    await withPage(
      async ({ page }) => {
        const { dialogs, before, after, cycles } = await openAndClose(page, WARM_UP, () => {
          attempt.tried();
          return attempt.goesOn();
        });
        attempt.note(`${dialogs} dialogs, ${Object.keys(DROPS).length} drops in each cycle`);
        attempt.note(changeText(before, after));
        if (cycles < MIN_CYCLES) return;
        for (const what of grownPast(MAX_GROWTH, before, after, cycles)) attempt.gaveWay(what);
      },
      { size: { width: 1280, height: 800 }, drawn: true, before: countResources },
    );
  },
};

export interface OpenedAndClosed {
  /** How many in each cycle. */
  readonly dialogs: number;
  readonly before: PageResources;
  readonly after: PageResources;
  readonly cycles: number;
}

/**
 * Everything, again and again, at least once.
 * @param warmUp cycles that are not counted
 * @param goesOn asked after each other cycle
 * @param readsHeap see `resourcesOf`
 */
export async function openAndClose(
  page: Page,
  warmUp: number,
  goesOn: () => boolean,
  readsHeap = true,
): Promise<OpenedAndClosed> {
  await openWalker(page);
  const dialogs = (await dottedItems(page)).filter((path) => !ASK_ELSEWHERE.test(path.at(-1) ?? ''));
  for (let i = 0; i < warmUp; i++) await cycle(page, dialogs);
  const before = await resourcesOf(page, readsHeap);
  let cycles = 0;
  do {
    await cycle(page, dialogs);
    cycles++;
  } while (goesOn());
  return { dialogs: dialogs.length, before, after: await resourcesOf(page, readsHeap), cycles };
}

export async function openWalker(page: Page): Promise<void> {
  await page.waitForFunction(() => window.marrow?.characters().length);
  await dropFiles(page, WALKER_DROP);
  await page.waitForFunction(() => window.marrow.characters().some(({ name }) => name === 'walker'));
}

/** The labels that lead to an item: of a menu, of a submenu if it is in one, and its own. */
export type MenuPath = readonly string[];

/** The items of all menus that ask something, as their three dots say, and can be chosen now. */
function dottedItems(page: Page): Promise<readonly MenuPath[]> {
  return page.evaluate(() => {
    const label = (item: Element) => item.querySelector('.menu-label')?.firstChild?.textContent ?? '';
    const found: string[][] = [];
    const collect = (menu: Element | undefined, above: readonly string[]) => {
      for (const item of menu?.querySelectorAll<HTMLElement>('[role=menuitem]') ?? []) {
        const path = [...above, label(item)];
        if (item.getAttribute('aria-haspopup')) {
          item.click();
          collect([...document.querySelectorAll('[role=menu]')].at(-1), path);
        } else if (label(item).endsWith('…') && !item.ariaDisabled) found.push(path);
      }
    };
    for (const title of document.querySelectorAll<HTMLElement>('.menu-titles [role=menuitem]')) {
      title.click();
      collect(document.querySelector('[role=menu]') ?? undefined, [title.textContent ?? '']);
      title.click();
    }
    return found;
  });
}

/** Chooses an item, and closes the dialog that it opens. */
async function openDialog(page: Page, path: MenuPath): Promise<void> {
  await page.evaluate(([title, ...items]) => {
    const byLabel = (all: Iterable<HTMLElement>, wanted: string) => {
      for (const one of all) if (one.textContent?.startsWith(wanted)) return one;
      throw new Error(`No menu has ${wanted}.`);
    };
    byLabel(document.querySelectorAll('.menu-titles [role=menuitem]'), title).click();
    for (const item of items)
      byLabel([...document.querySelectorAll<HTMLElement>('[role=menuitem] .menu-label')], item).click();
  }, path);
  const isOpen = (wanted: boolean) =>
    page.waitForFunction((open) => (document.querySelector('dialog[open]') !== null) === open, wanted);
  await isOpen(true);
  await page.keyboard.press('Escape');
  await isOpen(false);
}

/** Everything once, and back. @param dialogs items that open one */
export async function cycle(page: Page, dialogs: readonly MenuPath[]): Promise<void> {
  await openMenus(page);
  for (const path of dialogs) await openDialog(page, path);
  const tabs = await page.locator('.timeline-tabs [role=tab]:not([hidden])').all();
  if (tabs.length < 2) throw new Error('The timeline has no tabs.');
  for (const tab of tabs) {
    const id = await tab.evaluate((own: HTMLElement) => {
      own.click();
      return own.id;
    });
    // Some are fetched first, and all of them drawn.
    await page.waitForFunction((of) => document.querySelector(`[aria-labelledby=${of}] > :not(.empty)`), id);
    await page.evaluate(() => new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next))));
  }
  await page.evaluate(async (toggled) => {
    await window.marrow.run('page.tab.curves');
    for (const id of toggled) await window.marrow.run(id);
  }, TOGGLED);
  for (const files of Object.values(DROPS)) await openAndUndo(page, files);
}

/** Opens each menu by a click, and closes it by Escape. */
function openMenus(page: Page): Promise<void> {
  return page.evaluate(async () => {
    const menus = () => document.querySelectorAll('[role=menu]').length;
    for (const title of document.querySelectorAll<HTMLElement>('.menu-titles [role=menuitem]')) {
      title.click();
      await new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)));
      if (menus() === 0) throw new Error(`The menu ${title.textContent} did not open.`);
      const at = document.activeElement ?? document.body;
      at.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true, cancelable: true }));
      if (menus() > 0) throw new Error(`The menu ${title.textContent} did not close.`);
    }
  });
}

async function openAndUndo(page: Page, files: readonly DroppedFile[]): Promise<void> {
  const encoded = files.map(({ name, bytes }) => ({ name, base64: Buffer.from(bytes).toString('base64') }));
  await page.evaluate(async (given) => {
    const decoded = given.map(({ name, base64 }) => ({
      name,
      content: Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)),
    }));
    // What is taken back before it was drawn has made nothing, and would be the first to do so in a later cycle.
    const drawn = () => new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)));
    const before = window.marrow.characters().length;
    const step = window.marrow.steps().undo;
    await window.marrow.open(decoded);
    await drawn();
    // What was refused, or compared, is no step.
    if (window.marrow.steps().undo !== step) window.marrow.undo();
    await drawn();
    if (window.marrow.characters().length !== before) throw new Error(`${given[0].name} is still open.`);
  }, encoded);
}
