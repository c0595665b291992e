/**
 * Keys as diamonds and tangent handles, over the curves; frames of samples as dots. Marks are drawn only where they can
 * be told apart: one per cell of the plot, selected ones first, then those in front. If keys are closer than a few
 * pixels, or in the thousands, cells are larger and marks smaller; a hundred thousand keys then cost one search per
 * cell. (Ten thousand diamonds cost a software canvas more than all curves.)
 */
import { firstNotBelow } from '../../../../math/search.ts';
import { keysOf } from '../../../../model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT, FLAT, LINEAR } from '../../../../model/takes/tangent-kinds.ts';
import { mixed } from '../scene/colours.ts';
import { handlesOf, type TangentHandle } from '../scene/handles.ts';
import { type CurveLine, type CurveScene, isFaint, lineOf } from '../scene/scene.ts';

import { traceMap } from '../scene/trace.ts';
import type { PictureColours } from './picture-colours.ts';

/** Half the size of a diamond. */
export const KEY_PIXELS = 4;
const SMALL_KEY_PIXELS = 2.5;
/** Keys closer than this on average count as dense, as do too many in view. */
const DENSE_PIXELS = 3;
const MAX_KEYS = 2000;
/** Sizes of the cells that hold one mark. */
const CELL = 4;
const DENSE_CELL = 16;
const DENSE_SELECTED_CELL = 8;
const CROWDED_SELECTED_CELL = 12;
/** With more marks than this, they aren't outlined one by one. */
const MAX_OUTLINED = 400;
/** Marks per path: Chromium takes 5 ms to fill a path of 1,200, and 0.3 ms to fill 24 of 50. */
const BATCH = 50;
const HANDLE_END_PIXELS = 3;
/** Frames closer than this have no dots. */
const FRAME_PIXELS = 9;
const FRAME_DOT = 2.25;

/** Occupied cells of the plot. */
class Cells {
  private taken = new Uint8Array(0);
  private columns = 0;
  private rows = 0;

  clear(width: number, height: number): void {
    this.columns = Math.ceil(width / CELL) + 4;
    this.rows = Math.ceil(height / CELL) + 4;
    const count = this.columns * this.rows;
    if (this.taken.length < count) this.taken = new Uint8Array(count);
    else this.taken.fill(0);
  }

  /** Takes a cell; false if it was taken. */
  take(x: number, y: number): boolean {
    const column = Math.floor(x / CELL) + 2;
    const row = Math.floor(y / CELL) + 2;
    if (column < 0 || row < 0 || column >= this.columns || row >= this.rows) return false;
    const cell = row * this.columns + column;
    if (this.taken[cell]) return false;
    this.taken[cell] = 1;
    return true;
  }
}

const cells = new Cells();
/** x, y, half size of each mark. */
let marks = new Float32Array(3 * 1024);
let markCount = 0;

function addMark(x: number, y: number, size: number): void {
  if (3 * markCount + 3 > marks.length) {
    const more = new Float32Array(2 * marks.length);
    more.set(marks);
    marks = more;
  }
  marks[3 * markCount] = x;
  marks[3 * markCount + 1] = y;
  marks[3 * markCount + 2] = size;
  markCount++;
}

/** @returns whether anything was drawn */
export function drawKeys(g: CanvasRenderingContext2D, scene: CurveScene, colours: PictureColours): boolean {
  const { space } = scene;
  g.save();
  g.beginPath();
  g.rect(0, 0, space.width, space.height);
  g.clip();
  cells.clear(space.width, space.height);
  const hasFrames = drawFrames(g, scene, colours);
  markCount = 0;
  const chosen = scene.selected.flatMap(({ channel, indices }) => {
    const line = lineOf(scene, channel);
    return line ? [selectedInView(scene, line, indices)] : [];
  });
  const crowd = chosen.reduce((sum, { from, to }) => sum + to - from, 0);
  for (const part of chosen) markSelected(scene, part, crowd > MAX_KEYS);
  const selectedCount = markCount;
  let inView = 0;
  const lines = scene.lines.filter((line) => !isFaint(scene, line));
  for (const line of lines) {
    const { from, to, dense } = keysInView(scene, line);
    if (!dense) inView += to - from;
  }
  for (let l = lines.length - 1; l >= 0; l--) markAll(scene, lines[l], inView > MAX_KEYS);
  g.strokeStyle = colours.plot;
  g.lineWidth = 1;
  fillMarks(g, selectedCount, markCount, colours.key);
  const handles = handlesOf(scene);
  drawHandles(g, scene, handles, colours);
  fillMarks(g, 0, selectedCount, colours.selected);
  g.restore();
  return hasFrames || markCount > 0 || handles.length > 0;
}

/** The keys of one line, over all else: of a faint one under the pointer. */
export function drawKeysOf(
  g: CanvasRenderingContext2D,
  scene: CurveScene,
  line: CurveLine,
  colours: PictureColours,
): void {
  cells.clear(scene.space.width, scene.space.height);
  markCount = 0;
  markAll(scene, line, false);
  g.strokeStyle = colours.plot;
  g.lineWidth = 1;
  fillMarks(g, 0, markCount, colours.key);
}

function keysInView(scene: CurveScene, line: CurveLine) {
  const { times } = keysOf(scene.take.channels[line.channel]);
  const map = traceMap(scene, line);
  const from = firstNotBelow(times, map.left - KEY_PIXELS / map.perSecond);
  const to = firstNotBelow(times, map.left + (map.width + KEY_PIXELS) / map.perSecond);
  const pixels = to > from ? Math.max(1, (times[to - 1] - times[from]) * map.perSecond) : 1;
  return { map, from, to, dense: to - from > 8 && (to - from) * DENSE_PIXELS > pixels };
}

/** Positions in `indices` of the selected keys in view. */
function selectedInView(scene: CurveScene, line: CurveLine, indices: readonly number[]) {
  const view = keysInView(scene, line);
  return { line, indices, map: view.map, from: firstNotBelow(indices, view.from), to: firstNotBelow(indices, view.to) };
}

function markSelected(scene: CurveScene, part: ReturnType<typeof selectedInView>, crowded: boolean): void {
  const { line, indices, map, from, to } = part;
  const { times, values } = keysOf(scene.take.channels[line.channel]);
  const dense = crowded || (to - from) * DENSE_PIXELS > map.width;
  const cell = crowded ? CROWDED_SELECTED_CELL : dense ? DENSE_SELECTED_CELL : CELL;
  let i = from;
  while (i < to) {
    const k = indices[i];
    const x = (times[k] - map.left) * map.perSecond;
    const y = map.bottom - (values[k] - map.low) * map.perUnit;
    mark(x, y, cell, dense ? SMALL_KEY_PIXELS + 0.5 : KEY_PIXELS);
    i++;
    if (!dense) continue;
    const next = ((Math.floor(x / cell) + 1) * cell) / map.perSecond;
    i = Math.max(i, firstNotBelow(indices, firstNotBelow(times, map.left + next)));
  }
}

function markAll(scene: CurveScene, line: CurveLine, crowded: boolean): void {
  const { times, values } = keysOf(scene.take.channels[line.channel]);
  const view = keysInView(scene, line);
  const { map, from, to } = view;
  const dense = crowded || view.dense;
  let k = from;
  while (k < to) {
    const x = (times[k] - map.left) * map.perSecond;
    const y = map.bottom - (values[k] - map.low) * map.perUnit;
    mark(x, y, dense ? DENSE_CELL : CELL, dense ? SMALL_KEY_PIXELS : KEY_PIXELS);
    k++;
    if (!dense) continue;
    const next = map.left + ((Math.floor(x / DENSE_CELL) + 1) * DENSE_CELL) / map.perSecond;
    k = firstNotBelow(times, next, k, to);
  }
}

/** Adds a mark if its cell, of that size, is free. */
function mark(x: number, y: number, cell: number, size: number): void {
  if (cells.take(Math.floor(x / cell) * cell, Math.floor(y / cell) * cell)) addMark(x, y, size);
}

function fillMarks(g: CanvasRenderingContext2D, from: number, to: number, colour: string): void {
  if (from === to) return;
  g.fillStyle = colour;
  const edged = to - from <= MAX_OUTLINED;
  g.beginPath();
  for (let m = from; m < to; m++) {
    const x = marks[3 * m];
    const y = marks[3 * m + 1];
    const size = marks[3 * m + 2];
    g.moveTo(x, y - size);
    g.lineTo(x + size, y);
    g.lineTo(x, y + size);
    g.lineTo(x - size, y);
    g.closePath();
    if ((m - from) % BATCH < BATCH - 1 && m < to - 1) continue;
    if (edged) g.stroke();
    g.fill();
    g.beginPath();
  }
}

/** Small dots for the frames of sampled lines, unless too dense or too many. They aren't keys and can't be dragged. */
function drawFrames(g: CanvasRenderingContext2D, scene: CurveScene, colours: PictureColours): boolean {
  const { samples, columns } = scene.curves;
  if (!samples) return false;
  let hasAny = false;
  const { startSeconds, frameSeconds, frameCount, values, scales } = samples;
  const lines = scene.lines.filter((line) => columns[line.channel] >= 0);
  for (const line of lines) {
    const map = traceMap(scene, line);
    if (frameSeconds * map.perSecond < FRAME_PIXELS) return hasAny;
    const first = Math.max(0, Math.ceil((map.left - startSeconds) / frameSeconds));
    const end = Math.min(
      frameCount,
      Math.floor((map.left + map.width / map.perSecond - startSeconds) / frameSeconds) + 1,
    );
    if ((end - first) * lines.length > MAX_KEYS) return hasAny;
    hasAny ||= end > first;
    const column = columns[line.channel];
    g.fillStyle = mixed(line.colour, colours.palette);
    g.beginPath();
    for (let f = first; f < end; f++) {
      const x = (startSeconds + f * frameSeconds - map.left) * map.perSecond;
      const y = map.bottom - (values[f * scales.length + column] * scales[column] - map.low) * map.perUnit;
      g.moveTo(x + FRAME_DOT, y);
      g.arc(x, y, FRAME_DOT, 0, 2 * Math.PI);
      if ((f - first) % BATCH < BATCH - 1 && f < end - 1) continue;
      g.fill();
      g.beginPath();
    }
  }
  return hasAny;
}

/**
 * Their ends tell the kind of tangent: a bar if flat, a square if linear, a ring if smooth, a triangle if auto, a full
 * dot if fixed.
 */
function drawHandles(
  g: CanvasRenderingContext2D,
  scene: CurveScene,
  handles: readonly TangentHandle[],
  colours: PictureColours,
): void {
  if (handles.length === 0) return;
  g.strokeStyle = colours.selected;
  g.lineWidth = 1;
  g.beginPath();
  for (const { x, y, endX, endY } of handles) {
    g.moveTo(x, y);
    g.lineTo(endX, endY);
  }
  g.stroke();
  g.lineWidth = 1.25;
  for (const set of [false, true]) {
    g.beginPath();
    for (const { line, index, side, endX, endY } of handles) {
      const { tangentsIn, tangentsOut } = keysOf(scene.take.channels[line.channel]);
      const kind = (side === 'in' ? tangentsIn : tangentsOut).kinds[index];
      if ((kind === FIXED_TANGENT) === set) addHandleEnd(g, kind, endX, endY);
    }
    g.fillStyle = set ? colours.selected : colours.plot;
    g.fill();
    g.stroke();
  }
  g.strokeStyle = colours.plot;
  g.lineWidth = 1;
}

/** Of about the same area, so that none seems more important. */
function addHandleEnd(g: CanvasRenderingContext2D, kind: number, x: number, y: number): void {
  const r = HANDLE_END_PIXELS;
  if (kind === FLAT) g.rect(x - 1.6 * r, y - 0.6 * r, 3.2 * r, 1.2 * r);
  else if (kind === LINEAR) g.rect(x - 0.9 * r, y - 0.9 * r, 1.8 * r, 1.8 * r);
  else if (kind === AUTO_TANGENT) {
    g.moveTo(x, y - 1.2 * r);
    g.lineTo(x + 1.2 * r, y + 0.9 * r);
    g.lineTo(x - 1.2 * r, y + 0.9 * r);
    g.closePath();
  } else {
    g.moveTo(x + r, y);
    g.arc(x, y, r, 0, 2 * Math.PI);
  }
}
