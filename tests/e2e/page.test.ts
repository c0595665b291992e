/**
 * User input on the page: dropping folders and zips, picking, scrubbing, sliding, in both themes and on a small page.
 */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { strToU8, zipSync } from 'fflate';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { dropFiles, dropPaths, readPixels, withPage } from '../helpers/page.ts';

const ARM = `balljoint shoulder {
	boxmin -0.1 0 -0.1
	boxmax 0.1 1 0.1
	rotxlimit -1 1
	balljoint elbow { offset 0 1 0 boxmin -0.1 0 -0.1 boxmax 0.1 1 0.1 }
}`;
const CHANNEL = 'channel { extrapolate constant constant keys 1 { 0 0 flat flat } }';
const RAISE = `animation { range 0 2 numchannels 9 ${CHANNEL} ${CHANNEL} ${CHANNEL}
	channel { extrapolate constant constant keys 2 { 0 0 linear linear 2 1 linear linear } }
	${CHANNEL} ${CHANNEL} ${CHANNEL} ${CHANNEL} ${CHANNEL} }`;

const shown = (page: Page, name: string) =>
  page.waitForFunction((wanted) => window.marrow?.characters().some((c) => c.name === wanted), name);
const ready = (page: Page) => page.waitForFunction(() => window.marrow?.characters().length);
const dof = (page: Page, index: number) => page.evaluate((i) => window.marrow.characters()[0].dofs[i], index);
const openArm = async (page: Page) => {
  await ready(page);
  await dropFiles(page, [{ name: 'arm.skel', bytes: ARM }]);
  await shown(page, 'arm');
};

/**
 * What shows the time, in each of some frames of playback at four times the speed: the field, then the labels of the
 * playheads of scrubber and timeline, and the pose in the picture, as drawn.
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
    const panel = this.canvas.closest('.scrubber, .curve-plot, .dope-sheet');
    // Of the ruler's labels only the playhead's is centred.
    if (panel && this.textAlign === 'center') labels.set(panel.className, Number(text));
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
  await next();
  await next();
  const times: number[][] = [];
  const field = document.querySelector<HTMLInputElement>('.time-field');
  for (let frame = 0; frame < 15; frame++) {
    times.push([Number(field?.value), ...labels.values(), drawn]);
    await next();
  }
  marrow.pause();
  Object.assign(canvas, { fillText });
  Object.assign(gl, { drawElements });
  return times;
}

describe('dropping', () => {
  it('takes a folder, and what is in its folders', () =>
    withPage(async ({ page }) => {
      const folder = mkdtempSync(join(tmpdir(), 'marrow-arm-'));
      try {
        writeFileSync(join(folder, 'arm.skel'), ARM);
        writeFileSync(join(folder, 'arm_raise.anim'), RAISE);
        await ready(page);
        await dropPaths(page, [folder]);
        await shown(page, 'arm');
        expect(await page.evaluate(() => window.marrow.characters()[0].clips)).toEqual(['arm_raise']);
      } finally {
        rmSync(folder, { recursive: true });
      }
    }));

  it('dropping takes a zip', () =>
    withPage(async ({ page }) => {
      await ready(page);
      const zip = zipSync({ 'arm/arm.skel': strToU8(ARM), 'arm/arm_raise.anim': strToU8(RAISE) });
      await dropFiles(page, [{ name: 'arm.zip', bytes: zip }]);
      await shown(page, 'arm');
      expect(await page.evaluate(() => window.marrow.characters()[0].clips)).toEqual(['arm_raise']);
    }));

  it('shows names and lines of files as text, whatever is in them', () =>
    withPage(async ({ page }) => {
      await ready(page);
      const trap = '<img src=x onerror=alert(1)>';
      await dropFiles(page, [{ name: `${trap}.skel`, bytes: `balljoint root { offset ${trap} }` }]);
      await page.getByText('onerror=alert(1)').first().waitFor();
      expect(await page.locator('img').count()).toBe(0);
    }));

  it('puts files together that come one after another', () =>
    withPage(async ({ page }) => {
      await openArm(page);
      await dropFiles(page, [{ name: 'raise.anim', bytes: RAISE }]);
      await page.waitForFunction(() => window.marrow.characters()[0].clips.length === 1);
      await page.evaluate(() => window.marrow.seek(1));
      expect(await dof(page, 3)).toBeCloseTo(0.5, 9);
    }));
});

describe('by hand', () => {
  it('a click on a joint selects it, in the tree and in the inspector', () =>
    withPage(async ({ page }) => {
      await openArm(page);
      await page.evaluate(() => window.marrow.run('draw.boxes.solid'));
      const selected = page.locator('[role=treeitem][aria-selected=true].row-joint');
      const at = await page.evaluate(async () => {
        // The camera may still be moving to what was opened.
        await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
        const elbow = window.marrow.worldMatrices('arm')[1];
        return window.marrow.pointOnPage([elbow[12], elbow[13] + 0.5, elbow[14]], 'arm');
      });
      if (!at) throw new Error('The arm is not shown.');
      await page.mouse.click(at.x, at.y);
      await selected.waitFor();
      expect(await selected.innerText()).toContain('elbow');
    }));

  it('letters typed in the tree go to rows when the focus came by keyboard, also after a right click there', () =>
    withPage(async ({ page }) => {
      await openArm(page);
      const tree = page.locator('.tree');
      await page.locator('.row-joint').first().click({ button: 'right' });
      await page.getByRole('menu').waitFor();
      await page.keyboard.press('Escape');
      await page.locator('canvas[role=application]').focus();
      await tree.focus();
      await page.keyboard.press('e');
      await page.locator('[role=treeitem][aria-selected=true]').filter({ hasText: 'elbow' }).waitFor();
      expect(await page.locator('.mode-switch [aria-checked=true]').textContent()).toBe('FK');
    }));

  it('a value typed into a slider’s field is clamped to its limit, and one undo step', () =>
    withPage(async ({ page }) => {
      await openArm(page);
      await page.locator('.row-joint').first().click();
      const field = page.getByRole('textbox', { name: 'rx' }).first();
      await field.fill('90');
      await field.press('Enter');
      expect(await dof(page, 3)).toBeCloseTo(1, 9);
      await page.locator('.viewport canvas[role=application]').focus();
      await page.keyboard.press('Control+z');
      expect(await dof(page, 3)).toBe(0);
      for (const [typed, degrees] of [
        ['+=10', 10],
        ['*2', 20],
        ['-=5', 15],
      ] as const) {
        await field.fill(typed);
        await field.press('Enter');
        expect(await dof(page, 3)).toBeCloseTo((degrees * Math.PI) / 180, 9);
      }
    }));

  it('a drag through the scrubber moves time, and Space plays', () =>
    withPage(async ({ page }) => {
      await openArm(page);
      await dropFiles(page, [{ name: 'raise.anim', bytes: RAISE }]);
      await page.waitForFunction(() => window.marrow.characters()[0].clips.length === 1);
      await page.evaluate(() => {
        window.marrow.pause();
        window.marrow.seek(0);
      });
      const bar = await page.locator('canvas.scrubber').boundingBox();
      if (!bar) throw new Error('The scrubber has no place.');
      await page.mouse.move(bar.x + bar.width / 4, bar.y + bar.height * 0.7);
      await page.mouse.down();
      await page.mouse.move(bar.x + bar.width / 2, bar.y + bar.height * 0.7, { steps: 4 });
      await page.mouse.up();
      const there = await dof(page, 3);
      expect(there).toBeGreaterThan(0.3);
      expect(there).toBeLessThan(0.7);
      await page.locator('.viewport canvas[role=application]').focus();
      await page.keyboard.press(' ');
      await page.waitForFunction((then) => window.marrow.characters()[0].dofs[3] !== then, there);
      for (const tab of ['Curves', 'Dope sheet']) {
        await page.getByRole('tab', { name: tab }).click();
        const times = await page.evaluate(timesOfFrames);
        expect(new Set(times.map(([field]) => field)).size).toBeGreaterThan(5);
        for (const [field, ...others] of times) {
          expect(others).toHaveLength(3);
          // Labels have two decimals.
          for (const other of others) expect(Math.abs(other - field)).toBeLessThan(0.0056);
        }
      }
    }));
});

describe('the look', () => {
  it.each([
    ['light', 1440, 900],
    ['dark', 1024, 640],
    ['light', 390, 780],
  ] as const)('fits %s at %i × %i, without scroll bars of the page', (colorScheme, width, height) =>
    withPage(
      async ({ page }) => {
        await ready(page);
        // A screenshot waits for a frame.
        await page.evaluate(() => window.marrow.pause());
        const overflow = await page.evaluate(() => {
          const { scrollWidth, clientWidth, scrollHeight, clientHeight } = document.documentElement;
          return [scrollWidth - clientWidth, scrollHeight - clientHeight];
        });
        expect(overflow).toEqual([0, 0]);
        const { data } = await readPixels(page, { x: 2, y: 2, width: 4, height: 4 });
        const isLight = data[0] > 128;
        expect(isLight).toBe(colorScheme === 'light');
      },
      { colorScheme, size: { width, height }, walking: true },
    ),
  );

  it('the look comes back after the graphics context was lost', () =>
    withPage(
      async ({ page }) => {
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
      // three.js logs the lost context.
      { expected: /Context Lost|context lost/i, walking: true },
    ));
});
