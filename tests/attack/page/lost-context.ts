/** The graphics context is lost and restored in whatever the page does. */
import type { Page } from 'playwright-core';
import { dropFiles, readPixels, withPage } from '../../helpers/page.ts';
import {
  changeText,
  countResources,
  grownPast,
  type PageResources,
  resourcesOf,
} from '../../helpers/page-resources.ts';
import type { Attack } from '../attack.ts';
import { openWalker } from './open-close.ts';

const STATES = ['idle', 'playing', 'dragging', 'loading', 'frozen'] as const;
/** What all losses may leave: what comes and goes with messages and tooltips. Objects on the GPU are lost uncounted. */
const MAX_LEFT: Partial<PageResources> = {
  nodes: 60,
  listeners: 60,
  geometries: 2,
  textures: 2,
  observers: 2,
  objectUrls: 2,
};
/** What each may leave on average, over as many as tell. */
const MAX_PER_LOSS: Partial<PageResources> = { heapBytes: 10_000 };
const MIN_LOSSES = 20;
/** Parts of the viewport: beside the character, above messages. */
const DRAG_FROM = { x: 0.9, y: 0.6 };

export const lostContext: Attack = {
  name: 'lost-context',
  shows: 'the same pixels after each loss of the graphics context, and resources level',
  async run(attempt) {
    await withPage(
      async ({ page }) => {
        await openWalker(page);
        // The outline of what has the focus is in the picture.
        const { x, y } = await stageOf(page);
        await page.mouse.click(x + 20, y + 200);
        const look = async () => {
          await page.evaluate(async () => {
            window.marrow.pause();
            window.marrow.seek(0.5);
            // Drags and openings have moved the camera.
            await window.marrow.run('view.frameAll');
            await window.marrow.run('view.front');
          });
          await page.mouse.move(0, 0);
          await settled(page);
          return readPixels(page, await stageOf(page));
        };
        const first = await look();
        await loseContext(page);
        await restoreContext(page);
        const before = await resourcesOf(page, attempt.readsHeap);
        let losses = 0;
        for (; attempt.goesOn(); losses++) {
          const state = STATES[losses % STATES.length];
          await loseIn(page, state);
          attempt.tried();
          const now = await look();
          const differing = first.data.reduce((sum, value, i) => sum + (Math.abs(value - now.data[i]) > 2 ? 1 : 0), 0);
          if (differing > 0) attempt.gaveWay(`${differing} values differ after a loss while ${state}`);
        }
        const after = await resourcesOf(page, attempt.readsHeap);
        attempt.note(changeText(before, after));
        const perLoss = losses < MIN_LOSSES ? [] : grownPast(MAX_PER_LOSS, before, after, losses);
        for (const what of [...perLoss, ...grownPast(MAX_LEFT, before, after)]) attempt.gaveWay(what);
      },
      {
        size: { width: 800, height: 480 },
        drawn: true,
        before: countResources,
        expected: /Context Lost|context lost/i,
      },
    );
  },
};

async function stageOf(page: Page) {
  const box = await page.locator('.viewport').boundingBox();
  if (!box) throw new Error('The viewport has no place.');
  return box;
}

async function loseIn(page: Page, state: (typeof STATES)[number]): Promise<void> {
  const { x, y, width, height } = await stageOf(page);
  switch (state) {
    case 'idle':
      await loseContext(page);
      return restoreContext(page);
    case 'playing':
      await page.evaluate(() => window.marrow.play());
      await loseContext(page);
      await settled(page);
      return restoreContext(page);
    case 'dragging': {
      const from = { x: x + DRAG_FROM.x * width, y: y + DRAG_FROM.y * height };
      const isFree = await page.evaluate(({ x, y }) => document.elementFromPoint(x, y)?.localName === 'canvas', from);
      if (!isFree) throw new Error('Something covers the viewport where the drag begins.');
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      await page.mouse.move(x + 0.8 * width, y + 0.5 * height, { steps: 2 });
      await loseContext(page);
      await page.mouse.move(x + 0.7 * width, y + 0.6 * height, { steps: 2 });
      await restoreContext(page);
      await page.mouse.up();
      return;
    }
    case 'loading':
      await loseContext(page);
      await dropFiles(page, [{ name: 'other.skel', bytes: 'balljoint other { boxmin 0 0 0 boxmax 1 3 1 }' }]);
      await page.waitForFunction(() => window.marrow.characters().some(({ name }) => name === 'other'));
      await restoreContext(page);
      await page.evaluate(() => window.marrow.undo());
      return;
    case 'frozen': {
      const session = await page.context().newCDPSession(page);
      await loseContext(page);
      await session.send('Page.setWebLifecycleState', { state: 'frozen' });
      await session.send('Page.setWebLifecycleState', { state: 'active' });
      await session.detach();
      return restoreContext(page);
    }
  }
}

/** Two frames have passed. */
const settled = (page: Page) =>
  page.evaluate(
    () => new Promise<void>((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => resolve()))),
  );

/** Loses the context, and waits until the page has heard of it. */
export async function loseContext(page: Page): Promise<void> {
  await page.evaluate(
    () =>
      new Promise<void>((resolve) => {
        const canvas = document.querySelector<HTMLCanvasElement>('.viewport canvas[role=application]');
        const extension = canvas?.getContext('webgl2')?.getExtension('WEBGL_lose_context');
        if (!canvas || !extension) throw new Error('The viewport has no context to lose.');
        Object.assign(window, { lostContext: extension });
        canvas.addEventListener('webglcontextlost', () => setTimeout(resolve), { once: true });
        extension.loseContext();
      }),
  );
}

/** Restores it, and waits until it is drawn to. */
export async function restoreContext(page: Page): Promise<void> {
  await page.evaluate(
    () =>
      new Promise<void>((resolve) => {
        const canvas = document.querySelector<HTMLCanvasElement>('.viewport canvas[role=application]');
        canvas?.addEventListener('webglcontextrestored', () => requestAnimationFrame(() => resolve()), { once: true });
        // Put there by `loseContext`.
        (window as unknown as { lostContext: WEBGL_lose_context }).lostContext.restoreContext();
      }),
  );
}
