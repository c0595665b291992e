/**
 * Points of a C3D (c3d.org, "The C3D File Format User Guide", 2021): a head, parameters, and frames of points and analog
 * samples, which are passed over. A point is x y z and a word that is negative where the point is missing.
 */
import { USUAL_FRAMES_PER_SECOND } from '../../model/takes/take.ts';
import type { Budget } from '../budget.ts';
import type { Remarks } from '../imported.ts';
import { BLOCK, blocksIn, type Numbers, Parameters } from './c3d-parameters.ts';
import {
  FARTHEST,
  fail,
  holdMissing,
  isRate,
  labelsFor,
  MAX_POINTS,
  metresOf,
  POINT_WIDTH,
  type PointTable,
  roomFor,
} from './table.ts';

/** Bytes of the numbers in the head. */
const HEAD = { points: 2, analog: 4, first: 6, last: 8, scale: 12, data: 16, rate: 20 } as const;
/** The last frame of takes that are longer than the head can say. */
const MAX_IN_HEAD = 65_535;

/** Where frames are, and what they consist of. */
interface Layout {
  readonly pointCount: number;
  readonly frameCount: number;
  /** Of the first number. */
  readonly start: number;
  /** Numbers a frame, with those of analog samples, and bytes of each. */
  readonly width: number;
  readonly size: 2 | 4;
  /** Of whole numbers; 1 of floats. */
  readonly scale: number;
}

/** The points of a C3D. @throws ImportError if it is none, or is damaged */
export function readC3d(bytes: Uint8Array, budget: Budget, remarks: Remarks): PointTable {
  const parameters = new Parameters(bytes);
  const layout = layoutOf(parameters, bytes);
  const { pointCount, frameCount } = layout;
  const values = roomFor(pointCount, frameCount, budget);
  if (!writeFrames(parameters.numbers, layout, values)) holdMissing(values, pointCount, frameCount);
  const metres = metresIn(parameters, remarks);
  return {
    labels: labelsFor(labelsIn(parameters), pointCount),
    frameCount,
    framesPerSecond: rateIn(parameters, remarks),
    values,
    ...(metres !== undefined && { metres }),
  };
}

function layoutOf(parameters: Parameters, bytes: Uint8Array): Layout {
  const { numbers } = parameters;
  const pointCount = parameters.number('POINT', 'USED') ?? numbers.uint16(HEAD.points);
  if (pointCount === 0) fail('points-missing', 'Expected points, found none: the file has analog samples only.');
  if (!Number.isInteger(pointCount) || pointCount > MAX_POINTS) {
    fail('c3d-counts', `Expected at most ${MAX_POINTS} points, found POINT:USED ${pointCount}.`);
  }
  const frameCount = frameCountOf(parameters);
  const scale = parameters.number('POINT', 'SCALE') ?? numbers.float(HEAD.scale);
  if (!Number.isFinite(scale) || scale === 0) {
    fail('c3d-scale', `Expected in POINT:SCALE a factor, or a negative number for floats, found ${scale}.`);
  }
  const block = parameters.number('POINT', 'DATA_START') || numbers.uint16(HEAD.data);
  const start = (block - 1) * BLOCK;
  if (!(start >= BLOCK) || start >= bytes.length) {
    const message = `Expected frames at block ${block}, found a file of ${blocksIn(bytes)}: copy or export it again.`;
    fail('c3d-data', message);
  }
  const size = scale < 0 ? 4 : 2;
  const width = 4 * pointCount + numbers.uint16(HEAD.analog);
  const there = Math.floor((bytes.length - start) / (width * size));
  if (there < frameCount) {
    fail('c3d-cut', `Expected ${frameCount} frames, found ${there}: the file is cut off. Copy or export it again.`);
  }
  return { pointCount, frameCount, start, width, size, scale: scale < 0 ? 1 : scale };
}

/** The head counts to 65,535; of longer takes a parameter does, in two words each. */
function frameCountOf(parameters: Parameters): number {
  const { numbers } = parameters;
  const [first, last] = [numbers.uint16(HEAD.first), numbers.uint16(HEAD.last)];
  const long = (name: string) => {
    const [low, high] = [0, 1].map((word) => parameters.number('TRIAL', name, word));
    return low === undefined ? undefined : low + 65_536 * (high ?? 0);
  };
  const [from, to] = [long('ACTUAL_START_FIELD'), long('ACTUAL_END_FIELD')];
  const actual = from === undefined || to === undefined ? 0 : to - from + 1;
  const stated = last >= first && last > 0 ? last - first + 1 : 0;
  const counted = Math.floor(parameters.number('POINT', 'FRAMES') ?? 0);
  if (actual > MAX_IN_HEAD) return actual;
  // One that was left at the most that the head can say.
  if (last === MAX_IN_HEAD && counted > stated) return counted;
  const count = stated || actual || counted;
  if (count > 0) return count;
  return fail('frames-missing', `Expected frames, found the first to be ${first} and the last ${last}.`);
}

function labelsIn(parameters: Parameters): readonly string[] {
  const labels: string[] = [];
  for (let list = 1; ; list++) {
    const more = parameters.texts('POINT', list === 1 ? 'LABELS' : `LABELS${list}`);
    if (more.length === 0) return labels;
    labels.push(...more);
  }
}

function rateIn(parameters: Parameters, remarks: Remarks): number {
  const rate = parameters.number('POINT', 'RATE') ?? parameters.numbers.float(HEAD.rate);
  // In single precision, 59.94 is 59.9399986.
  const meant = Number(rate.toPrecision(7));
  if (isRate(rate)) return Math.fround(meant) === rate ? meant : rate;
  const message = `Expected frames per second in POINT:RATE, found ${rate}.`;
  remarks.warn('rate-expected', message, `used ${USUAL_FRAMES_PER_SECOND}`);
  return USUAL_FRAMES_PER_SECOND;
}

function metresIn(parameters: Parameters, remarks: Remarks): number | undefined {
  const [unit = ''] = parameters.texts('POINT', 'UNITS');
  const metres = metresOf(unit);
  if (metres === undefined && unit !== '') {
    remarks.warn('unit-unknown', `Expected a unit such as mm in POINT:UNITS, found ${unit}.`, 'guessed');
  }
  return metres;
}

/** Whether all points are there in all frames. */
function writeFrames(numbers: Numbers, layout: Layout, values: Float64Array): boolean {
  const { pointCount, frameCount, start, width, size, scale } = layout;
  const all = size === 4 ? floatsFrom(numbers, start) : integersFrom(numbers, start);
  const row = size === 4 ? new Float32Array(4 * pointCount) : new Int16Array(4 * pointCount);
  let missing = 0;
  let to = 0;
  for (let frame = 0; frame < frameCount; frame++) {
    if (!all) writeRow(numbers, start + frame * width * size, size, row);
    const from = all ? frame * width : 0;
    missing += writePoints(all ?? row, from, pointCount, scale, values, to);
    to += POINT_WIDTH * pointCount;
  }
  return missing === 0;
}

/** How many of a frame are missing; nothing is written for these. */
function writePoints(
  numbers: Float32Array | Int16Array,
  from: number,
  pointCount: number,
  scale: number,
  values: Float64Array,
  to: number,
): number {
  let missing = 0;
  for (let p = 0, at = from, o = to; p < pointCount; p++, at += 4, o += POINT_WIDTH) {
    const x = numbers[at] * scale;
    const y = numbers[at + 1] * scale;
    const z = numbers[at + 2] * scale;
    // What isn't finite is no position.
    if (numbers[at + 3] < 0 || !(Math.abs(x) + Math.abs(y) + Math.abs(z) < FARTHEST)) {
      missing++;
      continue;
    }
    values[o] = x;
    values[o + 1] = y;
    values[o + 2] = z;
    values[o + 3] = 1;
  }
  return missing;
}

/** Typed arrays are in the order of this machine, that of Intel as a rule. */
const IS_INTEL = new Uint8Array(Uint16Array.of(1).buffer)[0] === 1;

/** All numbers from there, without a copy; undefined if they are in another order. */
function floatsFrom({ bytes, processor }: Numbers, start: number): Float32Array | undefined {
  if (!IS_INTEL || processor !== 'intel') return undefined;
  const own = aligned(bytes, start, 4);
  return new Float32Array(own.buffer, own.byteOffset, own.length >> 2);
}

function integersFrom({ bytes, processor }: Numbers, start: number): Int16Array | undefined {
  if (!IS_INTEL || processor === 'mips') return undefined;
  const own = aligned(bytes, start, 2);
  return new Int16Array(own.buffer, own.byteOffset, own.length >> 1);
}

function aligned(bytes: Uint8Array, start: number, size: number): Uint8Array {
  const rest = bytes.subarray(start);
  return rest.byteOffset % size === 0 ? rest : rest.slice();
}

function writeRow(numbers: Numbers, start: number, size: 2 | 4, out: Float32Array | Int16Array): void {
  for (let i = 0; i < out.length; i++) {
    out[i] = size === 4 ? numbers.float(start + 4 * i) : numbers.int16(start + 2 * i);
  }
}
