/** User input on the page, and what it draws, in any browser. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import type { Check } from '../../helpers/check.ts';
import { undoAll } from '../../helpers/one-page.ts';
import { dropFiles } from '../../helpers/page.ts';

export const ARM = `balljoint shoulder {
	boxmin -0.1 0 -0.1
	boxmax 0.1 1 0.1
	rotxlimit -1 1
	balljoint elbow { offset 0 1 0 boxmin -0.1 0 -0.1 boxmax 0.1 1 0.1 }
}`;
const CHANNEL = 'channel { extrapolate constant constant keys 1 { 0 0 flat flat } }';
export const RAISE = `animation { range 0 2 numchannels 9 ${CHANNEL} ${CHANNEL} ${CHANNEL}
	channel { extrapolate constant constant keys 2 { 0 0 linear linear 2 1 linear linear } }
	${CHANNEL} ${CHANNEL} ${CHANNEL} ${CHANNEL} ${CHANNEL} }`;

export const shown = (page: Page, name: string) =>
  page.waitForFunction((wanted) => window.marrow?.characters().some((c) => c.name === wanted), name);
export const ready = (page: Page) => page.waitForFunction(() => window.marrow?.characters().length);
export const dof = (page: Page, index: number) => page.evaluate((i) => window.marrow.characters()[0].dofs[i], index);
export const openArm = async (page: Page) => {
  await ready(page);
  await undoAll(page);
  await dropFiles(page, [{ name: 'arm.skel', bytes: ARM }]);
  await shown(page, 'arm');
};

/**
 * What shows the time, in each of some frames of playback at four times the speed: the field, then the flags of
 * playheads, and the pose in the picture, as drawn.
 */
async function timesOfFrames(): Promise<number[][]> {
  const { marrow } = window;
  const labels = new Map<string, number>();
  let drawn = Number.NaN;
  const { prototype: canvas } = CanvasRenderingContext2D;
  const { prototype: gl } = WebGL2RenderingContext;
  const { fillText } = canvas;
  const { drawElements } = gl;
  canvas.fillText = function (this: CanvasRenderingContext2D, text, ...place) {
    // Of the ruler's labels only the playhead's is centred; no plot has one of its own.
    const panel = this.canvas.closest('.timeline');
    if (panel && this.textAlign === 'center') labels.set(this.canvas.className, Number(text));
    fillText.call(this, text, ...place);
  };
  gl.drawElements = function (this: WebGL2RenderingContext, ...what) {
    drawn = 2 * marrow.characters()[0].dofs[3];
    drawElements.call(this, ...what);
  };
  marrow.run('play.rate.4');
  marrow.play();
  const next = () => new Promise(requestAnimationFrame);
  await next();
  await next();
  labels.clear();
  for (let frame = 0; frame < 200 && (frame < 2 || labels.size < 1); frame++) await next();
  const times: number[][] = [];
  const field = document.querySelector<HTMLInputElement>('.time-field');
  for (let frame = 0; frame < 30; frame++) {
    times.push([Number(field?.value), ...labels.values(), drawn]);
    await next();
  }
  marrow.pause();
  Object.assign(canvas, { fillText });
  Object.assign(gl, { drawElements });
  return times;
}

export const BY_HAND: readonly Check[] = [
  {
    name: 'a value typed into a slider’s field is clamped to its limit, and one undo step',
    async run({ page }) {
      await openArm(page);
      await page.locator('.row-joint').first().click();
      const field = page.getByRole('textbox', { name: 'rx' }).first();
      await field.fill('90');
      await field.press('Enter');
      await expect.poll(() => dof(page, 3)).toBeCloseTo(1, 9);
      await page.locator('.viewport canvas[role=application]').focus();
      await page.keyboard.press('Control+z');
      await expect.poll(() => dof(page, 3)).toBe(0);
      for (const [typed, degrees] of [
        ['+=10', 10],
        ['*2', 20],
        ['-=5', 15],
      ] as const) {
        await field.fill(typed);
        await field.press('Enter');
        await expect.poll(() => dof(page, 3)).toBeCloseTo((degrees * Math.PI) / 180, 9);
      }
    },
  },
  {
    name: 'a drag through the scrubber moves time, and Space plays',
    async run({ page }) {
      await openArm(page);
      await dropFiles(page, [{ name: 'raise.anim', bytes: RAISE }]);
      await page.waitForFunction(() => window.marrow.characters()[0].takes.length === 1);
      await page.evaluate(() => {
        window.marrow.pause();
        window.marrow.seek(0);
      });
      const bar = await page.locator('canvas.scrubber').boundingBox();
      if (!bar) throw new Error('The scrubber has no place.');
      await page.mouse.move(bar.x + bar.width / 4, bar.y + bar.height * 0.7);
      await page.mouse.down();
      await page.mouse.move(bar.x + bar.width / 2, bar.y + bar.height * 0.7, { steps: 4 });
      // As in a window that is made small in mid-drag.
      const show = (display: string) =>
        page.locator('canvas.scrubber').evaluate((canvas: HTMLElement, value) => {
          canvas.style.display = value;
        }, display);
      await show('none');
      await page.mouse.move(bar.x + bar.width / 3, bar.y + bar.height * 0.7, { steps: 2 });
      await show('');
      await page.mouse.up();
      const there = await dof(page, 3);
      expect(there).toBeGreaterThan(0.3);
      expect(there).toBeLessThan(0.7);
      const frame = Number(await page.getByRole('textbox', { name: 'Frame', exact: true }).inputValue());
      expect(frame).toBeGreaterThan(0);
      expect(Number.isInteger(frame)).toBe(true);
      await page.locator('.viewport canvas[role=application]').focus();
      await page.keyboard.press(' ');
      await page.waitForFunction((then) => window.marrow.characters()[0].dofs[3] !== then, there);
      for (const tab of ['curves', 'dope']) {
        await page.evaluate((id) => window.marrow.run(id), `page.tab.${tab}`);
        const times = await page.evaluate(timesOfFrames);
        const flags = times.map(([, flag]) => flag);
        expect(new Set(flags).size).toBeGreaterThan(10);
        expect(new Set(times.map(([field]) => field)).size).toBeGreaterThan(1);
        times.forEach(([field, flag, drawn], i) => {
          // Labels have two decimals.
          expect(Math.abs(flag - drawn)).toBeLessThan(0.0056);
          // Numbers change in one of ten frames.
          const before = flags.slice(Math.max(0, i - 10), i + 1);
          if (i >= 10) expect(Math.min(...before.map((time) => Math.abs(time - field)))).toBeLessThan(0.0056);
        });
      }
    },
  },
  {
    name: 'a drag that ends in another panel leaves the keys to that panel',
    // In a page where nothing has had the keys.
    options: {},
    async run({ page }) {
      await openArm(page);
      const stage = await page.locator('.stage').boundingBox();
      const plot = await page.locator('.curve-plot').boundingBox();
      if (!stage || !plot) throw new Error('A panel has no place.');
      await page.mouse.move(stage.x + 0.9 * stage.width, stage.y + 0.9 * stage.height);
      await page.mouse.down();
      await page.mouse.move(plot.x + plot.width / 2, plot.y + plot.height / 2, { steps: 3 });
      await page.mouse.up();
      await page.mouse.move(plot.x + plot.width / 2 + 5, plot.y + plot.height / 2);
      await page.waitForFunction(() =>
        document.querySelector('[data-active]')?.contains(document.querySelector('.curve-plot')),
      );
    },
  },
];

export const LOOK: readonly Check[] = [
  {
    name: 'the look comes back after the graphics context was lost',
    // three.js logs the lost context.
    options: { expected: /Context Lost|context lost/i, walking: true },
    async run({ page }) {
      await ready(page);
      const restored = await page.evaluate(
        () =>
          new Promise<boolean>((resolve) => {
            const canvas = document.querySelector<HTMLCanvasElement>('.viewport canvas[role=application]');
            const lose = canvas?.getContext('webgl2')?.getExtension('WEBGL_lose_context');
            canvas?.addEventListener('webglcontextrestored', () => resolve(true), { once: true });
            canvas?.addEventListener('webglcontextlost', () => requestAnimationFrame(() => lose?.restoreContext()));
            lose?.loseContext();
          }),
      );
      expect(restored).toBe(true);
      await page.evaluate(() => window.marrow.seek(1));
      await page.waitForFunction(() => window.marrow.stats().triangles > 1000);
    },
  },
];
