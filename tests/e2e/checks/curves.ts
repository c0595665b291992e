/** The drawn curves against the evaluator: every coloured pixel is on its curve, and the curve is complete. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { compileTake } from '../../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../src/evaluate/curves.ts';
import { readAnim } from '../../../src/formats/anim/read.ts';
import { keysOf, type Take } from '../../../src/model/takes/take.ts';
import type { Check } from '../../helpers/check.ts';
import { undoAll } from '../../helpers/one-page.ts';
import { dropFiles, type Pixels, readPixels } from '../../helpers/page.ts';

/** How much a pixel has to be redder than green and blue, or less red than both; of 255. */
const COLOURED = 24;
/** How much greener than blue, or bluer than green: the colours of moving along y and z are neighbours. */
const APART = 6;
/** A line is 1.5 pixels wide, with antialiased edges. */
const HALF_LINE_PIXELS = 2;

/** Rows of a column that have the colour of moving along x (0), y (1) or z (2) in the light theme. */
function colouredRows({ width, height, data }: Pixels, x: number, colour: number, from: number): number[] {
  const rows: number[] = [];
  for (let y = from; y < height; y++) {
    const [red, green, blue] = [0, 1, 2].map((i) => data[4 * (y * width + x) + i]);
    const isRed = red - Math.max(green, blue) > COLOURED;
    const isOther = Math.min(green, blue) - red > COLOURED - APART;
    if (colour === 0 ? isRed : isOther && (colour === 1 ? green - blue : blue - green) > APART) rows.push(y);
  }
  return rows;
}

async function plotBox(page: Page) {
  const box = await page.locator('.curve-plot').boundingBox();
  if (!box) throw new Error('The curve editor is not there.');
  return box;
}

/** Two points of a channel determine the mapping between pixels and seconds and values. */
async function mapping(page: Page, left: number, top: number) {
  const places = await page.evaluate(() => [window.marrow.placeOf(0, 0, 0), window.marrow.placeOf(0, 1, 1)]);
  const [a, b] = places;
  if (!a || !b) throw new Error('The curve editor does not show the channel.');
  return {
    timeAt: (x: number) => (x + left - a.x) / (b.x - a.x),
    xOf: (time: number) => a.x - left + time * (b.x - a.x),
    yOf: (value: number) => a.y - top + value * (b.y - a.y),
  };
}

export function drop(name: string, text: string | Uint8Array) {
  return async (page: Page) => {
    await undoAll(page);
    await dropFiles(page, [{ name, bytes: text }]);
    const stem = name.replace(/\.anim$/, '');
    await page.waitForFunction((n) => window.marrow.characters()[0]?.name === n, stem);
    // Moves the playhead away, as it is coloured too.
    await page.evaluate(() => window.marrow.seek(-100));
    await page.locator('.curve-plot').focus();
    await page.keyboard.press('a');
    // Hides the focus ring too.
    await page.locator('.curve-plot').blur();
    await page.waitForFunction(() => window.marrow.placeOf(0, 0, 0) !== undefined);
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  };
}

export async function expectDrawn(page: Page, take: Take): Promise<void> {
  const box = await plotBox(page);
  const picture = await readPixels(page, box);
  const { timeAt, xOf, yOf } = await mapping(page, box.x, box.y);
  const curves = compileTake(take);
  const edges = take.range.map(xOf);
  const top = 1;
  take.channels.map(keysOf).forEach(({ times }, channel) => {
    let solid = 0;
    let dotted = 0;
    let gaps = 0;
    // In the right gutter curves have their names.
    for (let x = 1; x < picture.width - 72; x++) {
      // The edges of the range have the accent colour.
      if (edges.some((edge) => Math.abs(edge - x) < 4)) continue;
      let low = Number.POSITIVE_INFINITY;
      let high = Number.NEGATIVE_INFINITY;
      for (let part = -1; part <= 2; part += 0.125) {
        const y = yOf(evaluateChannel(curves, channel, timeAt(x + part)));
        low = Math.min(low, y);
        high = Math.max(high, y);
      }
      const rows = colouredRows(picture, x, channel, top);
      const stray = rows.filter((y) => y + 1 < low - HALF_LINE_PIXELS || y > high + HALF_LINE_PIXELS);
      expect(stray, `channel ${channel} at ${timeAt(x)} s, drawn at ${rows}, is ${low} to ${high}`).toEqual([]);
      const inside = timeAt(x) > times[0] && timeAt(x + 1) < times[times.length - 1];
      const visible = low > top && high < picture.height && !coveredByKey(take, channel, x, xOf);
      if (!visible) continue;
      if (inside) {
        solid++;
        expect(rows.length, `channel ${channel} at ${timeAt(x)} s is drawn`).toBeGreaterThan(0);
      } else if (rows.length) dotted++;
      else gaps++;
    }
    // Dotted where extrapolated: neither solid nor missing.
    expect(solid).toBeGreaterThan(100);
    if (dotted + gaps > 60) expect(dotted / (dotted + gaps)).toBeGreaterThan(0.2);
    if (dotted + gaps > 60) expect(gaps).toBeGreaterThan(10);
  });
}

/** Keys and other curves cover the line. */
function coveredByKey(take: Take, channel: number, x: number, xOf: (time: number) => number): boolean {
  return take.channels.map(keysOf).some(({ times }, c) => {
    const near = Array.from(times).some((time) => Math.abs(xOf(time) - x) < 8);
    return near || (c > channel && crosses(take, channel, c, x, xOf));
  });
}

function crosses(take: Take, a: number, b: number, x: number, xOf: (time: number) => number): boolean {
  const curves = compileTake(take);
  const perPixel = 1 / (xOf(1) - xOf(0));
  const time = (x - xOf(0)) * perPixel;
  const gap = evaluateChannel(curves, a, time) - evaluateChannel(curves, b, time);
  const later = evaluateChannel(curves, a, time + 2 * perPixel) - evaluateChannel(curves, b, time + 2 * perPixel);
  return Math.abs(gap) < 0.05 || gap * later < 0;
}

/** Steps, a lone key, crossing curves, tangents of all kinds, and every extrapolation. */
const OWN = `animation { range 0 2 numchannels 3
  channel { extrapolate linear bounce keys 4 { 0 0.2 flat 3 0.5 0.9 smooth smooth 0.9 -0.4 linear linear 1.4 0 flat -2 } }
  channel { extrapolate cycle cycle_offset keys 4 { 0.2 -0.5 smooth smooth 0.8 -0.7 linear linear 0.8 0.1 flat flat 1.3 -0.2 smooth smooth } }
  channel { extrapolate constant cycle keys 3 { 0.1 -0.9 linear linear 1 -0.6 8 -8 1.7 -0.9 flat flat } }
}`;

export const CURVES: readonly Check[] = [
  {
    name: 'draws steps, tangents and extrapolations where the evaluator says',
    async run({ page }) {
      await drop('own.anim', OWN)(page);
      const take = readAnim(OWN, 'own.anim').value;
      if (!take) throw new Error('The fixture is broken.');
      await expectDrawn(page, take);
    },
  },
  {
    name: 'brings out the curve that is pointed at, with its name, and lets the others step back',
    async run({ page }) {
      await drop('own.anim', OWN)(page);
      const box = await plotBox(page);
      /** How strong the colours of the curves are: the first is red, the others aren't. */
      const strengths = async () => {
        const { width, height, data } = await readPixels(page, { ...box, width: box.width - 72 });
        let [red, others] = [0, 0];
        for (let i = 0; i < 4 * width * height; i += 4) {
          const more = data[i] - Math.max(data[i + 1], data[i + 2]);
          if (more > COLOURED) red += more;
          else others += Math.max(0, Math.min(data[i + 1], data[i + 2]) - data[i] - COLOURED);
        }
        return { red, others };
      };
      const before = await strengths();
      const on = await page.evaluate(() => window.marrow.placeOf(0, 0.9, -0.4));
      if (!on) throw new Error('The curve is not shown.');
      await page.mouse.move(on.x, on.y);
      await expect.poll(async () => (await strengths()).others / before.others).toBeLessThan(0.7);
      await expect.poll(async () => (await strengths()).red / before.red).toBeGreaterThan(1.1);
      // Its name is on a field of its colour then.
      const field = async () => {
        const { data } = await readPixels(page, { x: box.x + box.width - 40, y: box.y, width: 40, height: box.height });
        let filled = 0;
        for (let i = 0; i < data.length; i += 4) if (data[i] - Math.max(data[i + 1], data[i + 2]) > 60) filled++;
        return filled;
      };
      await expect.poll(field).toBeGreaterThan(200);
      await page.mouse.move(box.x - 40, box.y + 4);
      await expect.poll(async () => (await strengths()).others / before.others).toBeGreaterThan(0.97);
    },
  },
];
