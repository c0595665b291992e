/** Mouse, keys and touch at random over the whole page, with a real character: then everything is undone. */
import type { CDPSession, Page } from 'playwright-core';
import { dropFiles, withPage } from '../../helpers/page.ts';
import { hasShared, sharedBytes } from '../../helpers/shared.ts';
import type { Attack, Attempt } from '../attack.ts';

const SIZE = { width: 1024, height: 700 };
const WASP = ['wasp.skel', 'wasp.skin', 'wasp_walk.anim'];
/** Those of shortcuts, of fields, and of menus. No key that closes or reloads the page. */
const KEYS = [
  ...'abcdefghijklmnopqrstuvwxyz0123456789,.[]?'.split(''),
  ...['Space', 'Enter', 'Escape', 'Tab', 'Delete', 'Backspace', 'Home', 'End', 'PageUp', 'PageDown', 'F2', 'F6', 'F10'],
  ...['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown'],
];
const MODIFIERS = ['', '', '', 'Shift+', 'Control+', 'Alt+', 'Control+Shift+', 'Control+Alt+'];
/** The browser's own. */
const NOT =
  /^Control\+(Shift\+)?[nrtwqjipu]$|^Alt\+(ArrowLeft|ArrowRight|Home|F4|d|e|f)$|^Control\+(Shift\+)?[0-9]$|F10|^Alt\+Space$/i;
/** Events between two looks at whether the page is well. */
const STRETCH = 200;
/** What can be refused by a page that is driven at random. */
const EXPECTED = /net::ERR_ABORTED|Context Lost/;

export const randomWalk: Attack = {
  name: 'random-walk',
  shows: 'no error that nobody caught, and undo back to the very bytes',
  async run(attempt) {
    let round = 0;
    // Each in a page of its own: one that has opened everything is slow.
    do {
      const before = attempt.seed + round++;
      try {
        await walk(attempt);
      } catch (error) {
        attempt.gaveWay(`round ${round} (${before}): ${error instanceof Error ? error.message : String(error)}`);
      }
    } while (attempt.goesOn());
    attempt.note(`${round} pages`);
  },
};

async function walk(attempt: Attempt): Promise<void> {
  await withPage(
    async ({ page, problems }) => {
      page.on('filechooser', () => undefined);
      page.on('dialog', (dialog) => void dialog.accept().catch(() => undefined));
      await page.waitForFunction(() => window.marrow?.characters().length);
      const first = await textOf(page);
      if (hasShared) {
        await dropFiles(
          page,
          WASP.map((name) => ({ name, bytes: sharedBytes(`data/cse169/${name}`) })),
        );
      }
      const session = await page.context().newCDPSession(page);
      for (let stretch = 0; stretch < 10 && attempt.goesOn(); stretch++) {
        const done: string[] = [];
        for (let i = 0; i < STRETCH; i++) done.push(await event(page, session, attempt));
        attempt.tried(STRETCH);
        const found = problems.filter((problem) => !EXPECTED.test(problem));
        if (found.length > 0) {
          attempt.gaveWay(found[0], { extension: 'json', content: JSON.stringify({ problems: found, done }, null, 1) });
          return;
        }
      }
      await page.mouse.up();
      for (let i = 0; i < 6; i++) await page.keyboard.press('Escape');
      await page.evaluate(() => {
        window.marrow.pause();
        while (window.marrow.undo());
      });
      const last = await textOf(page);
      if (last !== first)
        attempt.gaveWay('undo does not lead back to the same bytes', { extension: 'txt', content: last });
    },
    {
      walking: true,
      touch: true,
      size: SIZE,
      expected: EXPECTED,
      before: () => {
        // Dialogs of the system, which nobody would close, and a print preview.
        for (const name of ['showSaveFilePicker', 'showOpenFilePicker', 'showDirectoryPicker']) {
          Object.defineProperty(window, name, { value: undefined });
        }
        window.print = () => undefined;
      },
    },
  );
}

/** The opening example as files. */
const textOf = (page: Page) =>
  page.evaluate(async () => {
    const names = window.marrow.characters().map(({ name }) => name);
    const texts = [await window.marrow.save('walker.skel'), await window.marrow.save('walker.anim')];
    return `${names.join()}\n${texts.join('\n')}`;
  });

/** One event, and what it was. */
async function event(page: Page, session: CDPSession, { random, below }: Attempt): Promise<string> {
  const x = below(SIZE.width);
  const y = below(SIZE.height);
  const chance = random();
  if (chance < 0.35) {
    const key = `${MODIFIERS[below(MODIFIERS.length)]}${KEYS[below(KEYS.length)]}`;
    if (!NOT.test(key)) await page.keyboard.press(key);
    return key;
  }
  if (chance < 0.6) {
    const button = (['left', 'left', 'left', 'right', 'middle'] as const)[below(5)];
    await page.mouse.click(x, y, { button });
    return `${button} ${x} ${y}`;
  }
  if (chance < 0.7) {
    await page.mouse.move(x, y);
    return `move ${x} ${y}`;
  }
  if (chance < 0.76) {
    await page.mouse.down();
    return 'down';
  }
  if (chance < 0.86) {
    await page.mouse.up();
    return 'up';
  }
  if (chance < 0.92) {
    await page.mouse.wheel(below(200) - 100, below(400) - 200);
    return 'wheel';
  }
  const touchPoints = [{ x, y }];
  await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints });
  if (chance < 0.96) {
    const moved = [{ x: below(SIZE.width), y: below(SIZE.height) }];
    await session.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: moved });
  }
  await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  return `touch ${x} ${y}`;
}
