/**
 * WCAG 2.2 AA by axe-core, in the built page. One page goes through the states twice. Each is checked on a large page in
 * one theme, and in the other on a small one: two of four on a phone's.
 */
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import type { AxeResults, RunOptions } from 'axe-core';
import type { Locator, Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { dropFiles, withPage } from '../helpers/page.ts';

declare global {
  interface Window {
    readonly axe: { run(context: string, options: RunOptions): Promise<AxeResults> };
  }
}

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

const OPTIONS: RunOptions = {
  runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa'],
  resultTypes: ['violations'],
  // Of styles from elsewhere, which no rule here needs.
  preload: false,
  // Where a node is, which is told by its HTML.
  selectors: false,
};

/** These can be over each other; the keys 1, 3, 7 and the View menu do the same, as 2.5.8 allows. */
const AXIS_BUTTON = 'aria-label="Look from';

const DESK = { width: 1440, height: 900 };
const TABLET = { width: 768, height: 1024 };
const PHONE = { width: 390, height: 780 };

/** For parts that were checked at the desk: what size and theme change of them. The rest is their markup, and the same. */
const OF_LOOK: RunOptions = {
  ...OPTIONS,
  runOnly: ['color-contrast', 'link-in-text-block', 'scrollable-region-focusable', 'target-size'],
};

/** An arm of two joints, with limits, and one keyed channel. */
const SKEL = `balljoint shoulder {
  boxmin -0.1 0 -0.1 boxmax 0.1 0.8 0.1
  balljoint elbow {
    offset 0 0.8 0 boxmin -0.1 0 -0.1 boxmax 0.1 0.8 0.1
    rotxlimit -1 1
  }
}
`;
const ANIM = `animation {
  range 0 2
  numchannels 9
  ${'channel { extrapolate constant constant keys 1 { 0 0 flat flat } }\n'.repeat(6)}
  channel { extrapolate cycle cycle keys 3 { 0 0 smooth smooth 1 1 smooth smooth 2 0 smooth smooth } }
  ${'channel { extrapolate constant constant keys 1 { 0 0 flat flat } }\n'.repeat(2)}
}
`;
/** The arm's world matrices at two times, as another program has them. */
const DUMP = [0, 1].map((time) => `time ${time}\n${'1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n'.repeat(2)}`).join('');
const ROOT = 'ROOT hips { OFFSET 0 0 0 CHANNELS 3 Xposition Yposition Zposition End Site { OFFSET 0 80 0 } }';
/** Takes that jump in the middle, and what is said of them. */
const TAKES = Array.from({ length: 21 }, (_, i) => ({
  name: `take${i + 1}.bvh`,
  bytes: `HIERARCHY ${ROOT} MOTION Frames: 16 Frame Time: 0.0333333\n${'0 90 0\n'.repeat(8)}40 90 0\n${'0 90 0\n'.repeat(7)}`,
}));
const REVIEW = 'path,verdict,stars,tags,notes\ntake1.bvh,good,4,calm,again\ntake2.bvh,bad,,,\n';
/** Has an error, for the message line and the list of messages. */
const BROKEN = 'balljoint broken { offset 0 one 0 }';

/** Also what is in a closed drawer. */
const click = async (target: Locator, ifAny = false) => {
  if (!ifAny || (await target.count()) > 0) await target.evaluate((e: HTMLElement) => e.click());
};
const run = (page: Page, id: string) => page.evaluate((command) => void window.marrow.run(command), id);
/** Panels are drawers on a small page, and closed. */
const open = (page: Page, panel: string) => click(page.locator(`.${panel}-button[aria-pressed=false]`), true);
const tab = (page: Page, name: string) => run(page, `page.tab.${name}`);
/** A tab whose panel has come. */
async function shownTab(page: Page, name: string): Promise<void> {
  await tab(page, name);
  const content = page.locator(`[aria-labelledby=timeline-tab-${name}] > :not(.empty)`);
  await content.first().waitFor({ state: 'attached' });
}

async function openArm(page: Page): Promise<void> {
  await dropFiles(page, [
    { name: 'arm.skel', bytes: SKEL },
    { name: 'arm.anim', bytes: ANIM },
  ]);
  await page.locator('[role=treeitem]', { hasText: 'elbow' }).first().waitFor({ state: 'attached' });
}

const TIMELINE = '[data-region=timeline]';
const DIALOG = 'dialog[open]';
const MENU = '[role=menu]';

/**
 * Each continues from the one before, and the first from the last. Of a state that changes one part of the page, that
 * part is checked: the rest was with the state before.
 */
const STATES: readonly (readonly [name: string, enter: (page: Page) => Promise<unknown>, part?: string])[] = [
  [
    'a take is open',
    async (page) => {
      await page.keyboard.press('Escape');
      await run(page, 'posing.fk');
      await run(page, 'posing.leave');
      await tab(page, 'curves');
    },
  ],
  [
    'a joint is selected, its curves are shown',
    async (page) => {
      await click(page.locator('[role=treeitem]', { hasText: 'elbow' }).first());
      await open(page, 'timeline');
      await page.locator('.curve-plot').waitFor();
    },
  ],
  [
    'the dope sheet is shown',
    async (page) => {
      await open(page, 'inspector');
      await shownTab(page, 'dope');
    },
    TIMELINE,
  ],
  ['takes are shown', (page) => shownTab(page, 'takes'), TIMELINE],
  [
    'takes to review',
    async (page) => {
      await dropFiles(page, [{ name: 'review.csv', bytes: REVIEW }, ...TAKES]);
      await tab(page, 'review');
      await page.locator('.review-row .review-worst', { hasText: 'm' }).first().waitFor({ state: 'attached' });
      await click(page.locator('.review-row', { hasText: 'take1' }).first());
      await page.locator('.review-flag').first().waitFor({ state: 'attached' });
    },
    TIMELINE,
  ],
  [
    'poses are shown',
    async (page) => {
      await run(page, 'pose.keep');
      await shownTab(page, 'poses');
    },
    TIMELINE,
  ],
  [
    'it is told why a curve has its values',
    async (page) => {
      await tab(page, 'curves');
      if ((await page.locator('.why').count()) === 0) await run(page, 'timeline.showsWhy');
      await page.locator('.why-body:not([hidden])').waitFor({ state: 'attached' });
    },
    TIMELINE,
  ],
  [
    'quantities are plotted in IK mode',
    async (page) => {
      await run(page, 'posing.ik');
      await tab(page, 'measure');
      await page.locator('.measure-legend li').first().waitFor();
    },
  ],
  [
    'the steps of a joint are shown in Rig mode',
    async (page) => {
      await run(page, 'posing.rig');
      await tab(page, 'steps');
      await page.locator('.step-matrix').first().waitFor();
    },
  ],
  [
    'the text of a file is shown, with what was changed and what it was',
    async (page) => {
      await run(page, 'posing.leave');
      await tab(page, 'source');
      await page.evaluate(() => {
        const { id = '' } = window.marrow.characters().find(({ name }) => name === 'arm') ?? {};
        void window.marrow.run('rig.rename', { characterId: id, joint: 1, name: 'elbow_2' });
      });
      await page.locator('.source-line[data-change="changed"]').waitFor();
      const old = page.locator('.source-line[data-change="old"]');
      await expect
        .poll(async () => {
          // A click is lost on a line that is drawn anew.
          if ((await old.count()) === 0) await click(page.locator('.source-line[data-change="changed"]'));
          await page.evaluate(() => new Promise(requestAnimationFrame));
          return old.count();
        })
        .toBeGreaterThan(0);
    },
    TIMELINE,
  ],
  [
    'a text is edited, and has an error',
    async (page) => {
      await click(page.locator('.source-tools button', { hasText: 'Edit' }));
      const field = page.getByRole('textbox', { name: /^Text of / }).and(page.locator(':focus'));
      await expect.poll(() => field.count()).toBe(1);
      await page.keyboard.press('Control+a');
      await page.keyboard.insertText(SKEL.replace('0.8 0 boxmin', 'x 0 boxmin'));
      await expect.poll(() => page.locator('.source-problems li').count()).toBeGreaterThan(0);
      await page.keyboard.press('Control+f');
      await page.keyboard.type('joint');
      await expect.poll(() => page.getByText('2 matches').count()).toBe(1);
    },
    TIMELINE,
  ],
  [
    'it is said what a program of one’s own should print',
    async (page) => {
      await click(page.locator('.source-edit-bar button', { hasText: 'Discard' }).first());
      await click(page.locator('.source-tools button', { hasText: 'Edit' }));
      await tab(page, 'compare');
      await page.locator('.compare-start').waitFor({ state: 'attached' });
    },
    TIMELINE,
  ],
  [
    'a dump is compared, and messages are shown',
    async (page) => {
      await dropFiles(page, [{ name: 'mine.txt', bytes: DUMP }]);
      await page.locator('.compare-row').first().waitFor({ state: 'attached' });
      await page.locator('.compare-banner[data-tone=differs]').waitFor();
      await open(page, 'outliner');
      await dropFiles(page, [{ name: 'broken.skel', bytes: BROKEN }]);
      await page.locator('.message-line').waitFor();
    },
  ],
  [
    'the viewport’s menu is open',
    async (page) => {
      await run(page, 'compare.stop');
      await page.getByRole('application', { name: 'Viewport' }).focus();
      await page.keyboard.press('Shift+F10');
      await page.getByRole('menu').waitFor();
    },
    MENU,
  ],
  [
    'the dialog Picture is open',
    async (page) => {
      await page.keyboard.press('Escape');
      await run(page, 'save.picture');
      await page.getByRole('dialog', { name: 'Picture' }).waitFor();
    },
    DIALOG,
  ],
  [
    'the dialog Video is open',
    async (page) => {
      await page.keyboard.press('Escape');
      await run(page, 'save.video');
      await page
        .getByRole('dialog', { name: 'Video' })
        .getByText(/\d frames, /)
        .waitFor();
    },
    DIALOG,
  ],
  [
    'a dialog is open',
    async (page) => {
      await page.keyboard.press('Escape');
      await run(page, 'help.shortcuts');
      await page.getByRole('dialog').waitFor();
    },
    DIALOG,
  ],
];

it('the page meets WCAG 2.2 AA in every state, theme and size', { timeout: 240_000 }, () =>
  withPage(async ({ page }) => {
    const session = await page.context().newCDPSession(page);
    // The page's own security policy lets no foreign script in.
    await session.send('Runtime.evaluate', { expression: AXE });
    // By it axe places elements on the page: those that are hidden have no place, and take longest.
    await page.evaluate(() => {
      const walk = document.createTreeWalker.bind(document);
      document.createTreeWalker = (root, shown) =>
        walk(root, shown, (node) =>
          node instanceof Element && !node.checkVisibility() ? NodeFilter.FILTER_REJECT : NodeFilter.FILTER_ACCEPT,
        );
    });
    await openArm(page);
    const found: string[] = [];
    for (const isSmall of [false, true]) {
      for (const [s, [state, enter, part]] of STATES.entries()) {
        const size = !isSmall ? DESK : s % 4 < 2 ? PHONE : TABLET;
        // Both themes at every size, with few changes.
        const colorScheme = s < STATES.length / 2 === isSmall ? 'dark' : 'light';
        await page.setViewportSize(size);
        await page.emulateMedia({ colorScheme });
        await enter(page);
        await page.evaluate(() => new Promise(requestAnimationFrame));
        const { violations } = await page.evaluate(([context, options]) => window.axe.run(context, options), [
          part ?? 'html',
          isSmall && part ? OF_LOOK : OPTIONS,
        ] as const);
        for (const { id, nodes } of violations) {
          for (const { html, failureSummary } of nodes) {
            if (id === 'target-size' && html.includes(AXIS_BUTTON)) continue;
            found.push(
              `${state}, ${size.width} × ${size.height}, ${colorScheme}: ${id}\n  ${html}\n  ${failureSummary}`,
            );
          }
        }
      }
    }
    expect(found).toEqual([]);
  }),
);

/** The panel, role and name of what has the focus. */
const focused = (page: Page) =>
  page.evaluate(() => {
    const { activeElement: at } = document;
    const panel = at?.closest<HTMLElement>('[data-region]')?.dataset.region;
    return { panel, role: at?.role ?? at?.localName, name: at?.ariaLabel ?? at?.textContent };
  });

it('the keyboard reaches everything: F6 the panels, arrows the buttons of a toolbar; Escape closes a dialog', () =>
  withPage(
    async ({ page }) => {
      await openArm(page);
      await click(page.locator('[role=treeitem]', { hasText: 'elbow' }).first());
      await page.getByRole('textbox', { name: 'rx of elbow, degrees' }).first().waitFor();
      await page.locator('.curve-plot').waitFor();
      const viewport = page.getByRole('application', { name: 'Viewport' });
      await viewport.focus();
      const keys = await viewport.getAttribute('aria-describedby');
      await expect.poll(() => page.locator(`#${keys}`).textContent()).toContain('F6');

      const panels: (string | undefined)[] = [];
      for (const key of ['F6', 'F6', 'F6', 'F6', 'F6', 'F6', 'Shift+F6', 'Shift+F6']) {
        await page.keyboard.press(key);
        panels.push((await focused(page)).panel);
      }
      const order = ['inspector', 'transport', 'timeline', 'menuBar', 'outliner', 'stage'];
      expect(panels).toEqual([...order, 'outliner', 'menuBar']);

      // T leads into the outliner, Escape back.
      await viewport.focus();
      const byKey: (string | undefined)[] = [];
      for (const key of ['t', 'Escape', 't']) {
        await page.keyboard.press(key);
        byKey.push((await focused(page)).panel);
      }
      expect(byKey).toEqual(['outliner', 'stage', 'outliner']);
      await expect.poll(() => page.locator('.tree:focus .focused').getAttribute('aria-selected')).toBe('true');

      // Enter leaves a field for its panel: keys are shortcuts again, and F6 and Tab go on from there.
      const rx = page.getByRole('textbox', { name: 'rx of elbow, degrees' }).first();
      for (const [key, region, field] of [
        ['F6', 'transport', undefined],
        ['Tab', 'inspector', 'rx of elbow, degrees'],
      ] as const) {
        await rx.fill(field ? '20' : '10');
        await page.keyboard.press('Enter');
        await expect.poll(() => focused(page)).toMatchObject({ panel: 'inspector', role: 'section' });
        await page.keyboard.press(key);
        const now = await focused(page);
        expect(now.panel).toBe(region);
        expect(now.name).not.toBe(field);
        expect(now.role).not.toBe('section');
      }

      // One tab stop, which the arrows move.
      const playback = page.getByRole('toolbar', { name: 'Playback' });
      await playback.getByRole('button').first().focus();
      await page.keyboard.press('ArrowRight');
      await expect.poll(async () => (await focused(page)).name).toBe('Go to previous key');
      await page.keyboard.press('End');
      await expect.poll(async () => (await focused(page)).name).toBe('Go to range end');
      await page.keyboard.press('ArrowRight');
      await expect.poll(async () => (await focused(page)).name).toBe('Go to range start');
      await expect.poll(() => playback.locator('button[tabindex="0"]').count()).toBe(1);
      await page.keyboard.press('Tab');
      await expect.poll(() => playback.locator(':focus').count()).toBe(0);

      const headings = await page.getByRole('heading', { level: 2 }).allTextContents();
      expect(headings).toEqual(['Outliner', 'Viewport', 'Inspector', 'Transport', 'Timeline']);

      // From a field with another number too.
      await run(page, 'timeline.resample');
      const field = page.getByRole('dialog').getByRole('textbox').first();
      await field.fill('7');
      await page.keyboard.press('Escape');
      await page.getByRole('dialog').waitFor({ state: 'detached' });
    },
    { size: DESK },
  ));

it('forced colours tell what is pressed, checked and selected', () =>
  withPage(async ({ page }) => {
    await openArm(page);
    await click(page.locator('[role=treeitem]', { hasText: 'elbow' }).first());
    await page.locator('.curve-plot').waitFor();
    await page.emulateMedia({ forcedColors: 'active' });
    const alike = await page.evaluate(() => {
      const background = (state: string) => {
        const [on, off] = ['true', 'false'].map((value) => document.querySelector(state.replace('?', value)));
        return on && off ? [on, off].map((one) => getComputedStyle(one).backgroundColor) : [];
      };
      return ['.tool[aria-pressed=?]:not(.auto-key)', '.mode-switch [aria-checked=?]', '.timeline-tab[aria-selected=?]']
        .map((state) => [state, ...background(state)] as const)
        .filter(([, on, off]) => on === undefined || on === off);
    });
    expect(alike).toEqual([]);
    const unread = await page.evaluate(() =>
      ['.row[aria-selected=true]', '.tabs > [aria-selected=true]', '.mode-switch [aria-checked=true]'].filter(
        (state) => {
          const chosen = document.querySelector(state);
          if (!chosen) return true;
          const { color, backgroundColor } = getComputedStyle(chosen);
          const texts = [chosen, ...chosen.querySelectorAll('*')].map((one) => getComputedStyle(one).color);
          return color === backgroundColor || texts.some((text) => text !== color);
        },
      ),
    );
    expect(unread).toEqual([]);
    const tracks = await page.evaluate(() =>
      [...document.querySelectorAll('.lil-slider')].map((slider) => getComputedStyle(slider).backgroundImage),
    );
    expect(tracks.length).toBeGreaterThan(0);
    expect(tracks).not.toContain('none');
  }));

/** Controls that can be seen and are smaller than a finger; separators are dragged and have fields or keys as well. */
const smallTargets = (page: Page) =>
  page.evaluate(() => {
    const controls = document.querySelectorAll<HTMLElement>(
      'button,select,input:not([type=range]),[role=menuitem],[role=menuitemcheckbox],[role=tab],[role=treeitem],.steps .number',
    );
    const isHit = (one: HTMLElement) => {
      const { left, right, top, bottom } = one.getBoundingClientRect();
      const at = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
      return at !== null && (one === at || one.contains(at));
    };
    return [...controls]
      .filter((one) => isHit(one) && !one.closest('[role=group][aria-label="Look along an axis"],label'))
      .map((one) => ({ one, box: one.getBoundingClientRect() }))
      .filter(({ box }) => box.height < 43.5 || box.width < 43.5)
      .map(({ one, box }) => `${one.className}, ${one.ariaLabel ?? one.textContent}: ${box.width} × ${box.height}`);
  });

/** Controls and texts of the menu bar that are over each other, or beyond its edges. */
const overlapsInMenuBar = (page: Page) =>
  page.evaluate(() => {
    const parts = [...document.querySelectorAll('.menu-bar :is(button, .unsaved-text, .loaded-text)')]
      .map((part) => ({ name: part.ariaLabel ?? part.textContent, box: part.getBoundingClientRect() }))
      .filter(({ box }) => box.width > 0 && box.right > 0)
      .sort((a, b) => a.box.left - b.box.left);
    return parts.flatMap(({ name, box }, i) => {
      const end = parts[i + 1]?.box.left ?? innerWidth;
      return box.right > end + 0.5 ? [`at ${innerWidth}: ${name} ends at ${box.right}, beyond ${end}`] : [];
    });
  });

it('a phone has all menus, the timeline and targets of 44 pixels; nothing in the menu bar is over anything else', () =>
  withPage(
    async ({ page }) => {
      await openArm(page);
      const small = await smallTargets(page);
      await page.keyboard.press('c');
      await page.locator('.curve-plot').waitFor();
      for (const name of ['dope', 'takes', 'poses', 'measure', 'source', 'curves']) {
        await tab(page, name);
        await page.locator(`[aria-labelledby=timeline-tab-${name}] > :not(.empty)`).first().waitFor();
        small.push(...(await smallTargets(page)));
      }
      await page.locator('canvas').first().focus();
      await page.keyboard.press('ArrowDown');
      await tab(page, 'steps');
      await page.locator('.steps .symbol').first().waitFor();
      small.push(...(await smallTargets(page)));
      await open(page, 'inspector');
      await page.getByRole('textbox', { name: 'tx' }).first().waitFor();
      small.push(...(await smallTargets(page)));
      await page.keyboard.press('Escape');
      await page.getByRole('button', { name: 'Menu' }).tap();
      const menus = page.getByRole('menu').first().getByRole('menuitem');
      const titles = ['Open', 'Save', 'Examples', 'Edit', 'Rig', 'Keys', 'View', 'Play', 'Help'];
      await expect.poll(() => menus.allTextContents()).toEqual(titles);
      await menus.filter({ hasText: 'Help' }).tap();
      await page.getByRole('menuitem', { name: 'Shortcuts' }).waitFor();
      small.push(...(await smallTargets(page)));
      expect(small).toEqual([]);
      await page.getByRole('menuitem', { name: 'Back' }).tap();
      await expect.poll(() => page.getByRole('menu').count()).toBe(1);
      await page.keyboard.press('Escape');

      const long = 'an_arm_with_a_name_that_fills_the_whole_bar';
      await dropFiles(page, [
        { name: `${long}.skel`, bytes: SKEL },
        { name: `${long}.anim`, bytes: ANIM },
      ]);
      await page.locator('.loaded-text', { hasText: '2 characters' }).waitFor({ state: 'attached' });
      for (let unsaved = 0; unsaved < 3; unsaved++) {
        if (unsaved > 0) await run(page, 'take.new');
        for (const width of [390, 700, 768, 910, 1024]) {
          await page.setViewportSize({ width, height: 1024 });
          // Panels fold with the next frame.
          await expect.poll(() => overlapsInMenuBar(page)).toEqual([]);
        }
      }
      await page.setViewportSize({ width: 768, height: 1024 });
      await page.getByRole('menuitem', { name: 'Help' }).tap();
      await page.getByRole('menuitem', { name: 'Shortcuts' }).waitFor();
      await page.keyboard.press('Escape');

      const [undo, redo] = await page.locator('.undo-buttons > button').all();
      const names = async () => [await undo.getAttribute('aria-label'), await redo.getAttribute('aria-label')];
      await expect.poll(() => names()).toEqual([expect.stringMatching(/^Undo new take/), 'Redo']);
      await redo.tap({ force: true });
      await page.getByText('There is nothing to redo.').waitFor();
      await undo.tap();
      await expect
        .poll(() => names())
        .toEqual([expect.stringMatching(/^Undo/), expect.stringMatching(/^Redo new take/)]);
      await redo.tap();
      await expect.poll(() => names()).toEqual([expect.stringMatching(/^Undo new take/), 'Redo']);
    },
    { size: PHONE, touch: true },
  ));
