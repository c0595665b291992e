/** Parts of the dope sheet's picture: row backgrounds, held spans, the strip, the box, the readout. */

import { STILL } from '../../../edit/keys/marks.ts';
import { timeX } from '../../widgets/time/time-window.ts';
import type { SelectionBox } from '../timeline/box.ts';
import type { DopeRow } from '../timeline/dope-rows.ts';
import { readTimeColours, type TimeColours, translucent } from '../timeline/time-ground.ts';
import { GRIP } from './hit.ts';
import type { AttachedSpan, DopeOverlay, DopeScene } from './scene.ts';
import { HEAD, rowTop, type Sheet } from './sheet.ts';

export interface DopeColours extends TimeColours {
  readonly key: string;
  readonly band: string;
  readonly held: string;
  readonly selected: string;
  readonly selectedQuiet: string;
  readonly surface: string;
  readonly raised: string;
  readonly field: string;
  readonly text: string;
}

/** Margin beyond both edges: half a diamond of keys just outside is visible. */
export const PAD = 8;
const HELD_HEIGHT = 4;
const SAMPLED_HEIGHT = 6;
const SAMPLED_OPACITY = 0.35;

export function drawSheetGround(
  g: CanvasRenderingContext2D,
  sheet: Sheet,
  index: number,
  row: DopeRow,
  isSelected: boolean,
  colours: DopeColours,
): void {
  const top = rowTop(sheet, index);
  if (isSelected || row.kind === 'channel' || row.kind === 'character') {
    g.fillStyle = isSelected ? colours.selectedQuiet : row.kind === 'channel' ? colours.field : colours.raised;
    // Fainter than the name, so that the keys on it stay visible.
    g.globalAlpha = isSelected ? (row.kind === 'channel' ? 0.3 : 0.6) : 1;
    g.fillRect(0, top, sheet.width, sheet.rowHeight);
    g.globalAlpha = 1;
  }
  if (row.kind === 'summary') return;
  g.fillStyle = colours.fineLine;
  g.fillRect(0, top + sheet.rowHeight - 1, sheet.width, 1);
}

/** Bars between keys where nothing in the row changes. */
export function drawHeld(
  g: CanvasRenderingContext2D,
  moves: Uint8Array,
  [first, last]: readonly [number, number],
  y: number,
  colours: DopeColours,
): void {
  g.fillStyle = colours.held;
  const end = Math.min(moves.length, last);
  let pixel = Math.max(0, first);
  while (pixel < end) {
    const next = moves[pixel] === STILL ? moves.indexOf(1, pixel) : -1;
    if (moves[pixel] !== STILL) {
      const still = moves.indexOf(STILL, pixel);
      pixel = still < 0 ? end : still;
      continue;
    }
    const to = next < 0 ? end : Math.min(next, end);
    // From the centre of one key to the centre of the next.
    g.fillRect(pixel - PAD + 0.5, y - HELD_HEIGHT / 2, to - pixel, HELD_HEIGHT);
    pixel = to;
  }
}

/** A faint bar from the first frame to the last if a row has sampled channels. */
export function drawSampled(
  g: CanvasRenderingContext2D,
  sheet: Sheet,
  from: number,
  to: number,
  y: number,
  colours: DopeColours,
): void {
  const left = Math.max(-1, Math.round(timeX(sheet, from)));
  const right = Math.min(sheet.width + 1, Math.max(left + 1, Math.round(timeX(sheet, to))));
  if (!(right > left)) return;
  g.fillStyle = colours.band;
  g.globalAlpha = SAMPLED_OPACITY;
  g.fillRect(left, y - SAMPLED_HEIGHT / 2, right - left, SAMPLED_HEIGHT);
  g.globalAlpha = 1;
}

/** A bar for each span, with what is followed where there is room. */
export function drawAttached(
  g: CanvasRenderingContext2D,
  sheet: Sheet,
  spans: readonly AttachedSpan[],
  y: number,
  colours: DopeColours,
): void {
  const height = sheet.rowHeight - 6;
  g.font = colours.font;
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  for (const { from, to, label } of spans) {
    const left = Math.max(-PAD, Math.round(timeX(sheet, from)));
    const right = Math.min(sheet.width + PAD, Math.round(timeX(sheet, to)));
    if (!(right > left)) continue;
    g.fillStyle = translucent(colours.key, 0.35);
    g.beginPath();
    g.roundRect(left + 0.5, y - height / 2, right - left - 1, height, 3);
    g.fill();
    if (right - left < g.measureText(label).width + 12) continue;
    g.fillStyle = colours.text;
    g.fillText(label, Math.max(left, 0) + 6, y + 0.5);
  }
}

/** The selection from its first key to its last, with grips at both ends. */
export function drawStrip(g: CanvasRenderingContext2D, { sheet, selectedSpan }: DopeScene, colours: DopeColours): void {
  g.fillStyle = colours.surface;
  g.fillRect(0, 0, sheet.width, HEAD);
  g.fillStyle = colours.line;
  g.fillRect(0, HEAD - 1, sheet.width, 1);
  if (!selectedSpan) return;
  const start = Math.round(timeX(sheet, selectedSpan[0]));
  const end = Math.round(timeX(sheet, selectedSpan[1]));
  const top = 2;
  const height = HEAD - 5;
  g.fillStyle = translucent(colours.selected, 0.4);
  const from = Math.max(-GRIP, start);
  const to = Math.min(sheet.width + GRIP, end);
  if (end > start) g.fillRect(from, top + 1, Math.max(0, to - from), height - 2);
  g.fillStyle = colours.selected;
  for (const at of end > start ? [start - 3, end - 1] : [start - 2]) {
    g.beginPath();
    g.roundRect(at, top - 1, 4, height + 2, 1.5);
    g.fill();
  }
}

export function drawBox(g: CanvasRenderingContext2D, sheet: Sheet, box: SelectionBox, colours: DopeColours): void {
  const left = Math.max(-1, Math.min(box.x0, box.x1));
  const right = Math.min(sheet.width + 1, Math.max(box.x0, box.x1));
  const top = Math.max(HEAD, Math.min(box.y0, box.y1));
  const bottom = Math.min(sheet.height + 1, Math.max(box.y0, box.y1));
  g.fillStyle = translucent(colours.selected, 0.12);
  g.fillRect(left, top, right - left, bottom - top);
  g.strokeStyle = colours.selected;
  g.lineWidth = 1;
  g.strokeRect(Math.round(left) + 0.5, Math.round(top) + 0.5, Math.round(right - left), Math.round(bottom - top));
}

export function drawReadout(
  g: CanvasRenderingContext2D,
  sheet: Sheet,
  { x, y, text }: NonNullable<DopeOverlay['readout']>,
  colours: DopeColours,
): void {
  g.font = colours.font;
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  const width = Math.ceil(g.measureText(text).width) + 12;
  const left = Math.max(2, Math.min(sheet.width - width - 2, x + 12));
  const top = Math.max(HEAD, Math.min(sheet.height - 22, y + 12));
  g.fillStyle = colours.raised;
  g.strokeStyle = colours.line;
  g.lineWidth = 1;
  g.beginPath();
  g.roundRect(left + 0.5, top + 0.5, width, 19, 3);
  g.fill();
  g.stroke();
  g.fillStyle = colours.text;
  g.fillText(text, left + 6.5, top + 10.5);
}

export function readColours(target: Element): DopeColours {
  const style = getComputedStyle(target);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  return {
    ...readTimeColours(target),
    key: colour('--key'),
    band: colour('--dope-band'),
    held: colour('--dope-held'),
    selected: colour('--selected'),
    selectedQuiet: colour('--selected-quiet'),
    surface: colour('--surface'),
    raised: colour('--raised'),
    field: colour('--dope-channel'),
    text: colour('--text'),
  };
}
