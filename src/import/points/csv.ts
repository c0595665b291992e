/**
 * Points of a table with a row of names:
 *
 *     wide    frame and/or time, then NAME.x NAME.y NAME.z or NAME_x … of each point: a row a frame
 *     long    frame, a label (landmark, joint, name, id), x y z: a row a point of a frame
 *
 * Any case; further columns of a long table are passed over.
 */
import { USUAL_FRAMES_PER_SECOND } from '../../model/takes/take.ts';
import type { Budget } from '../budget.ts';
import type { Remarks } from '../imported.ts';
import { COMMA, lineCount, Rows, TAB, writePoint } from './rows.ts';
import { fail, holdMissing, labelsFor, MAX_POINTS, POINT_WIDTH, type PointTable, roomFor } from './table.ts';
import { rateOfTimes } from './times.ts';

const FRAME = /^frame(s|#|_?(number|index|id|no))?$/i;
const TIME = /^(time|t|seconds|timestamp)(_?s|\(s\)| \(s\))?$/i;
const LABEL = /^(landmark|joint|name|id)$/i;
const COORDINATE = /^(.*\S)[._]([xyz])$/i;
/** What programs that find people in videos tell of a point besides its place. */
const CONFIDENCE = /[._](v|c|visibility|presence|confidence|score|likelihood)$/i;
const SEMICOLON = 59;
/** Numbers of the joints of MediaPipe: 0 to 32. */
const NUMBERED = 33;

interface Wide {
  readonly kind: 'wide';
  readonly frame: number;
  readonly time: number;
  readonly labels: readonly string[];
  /** The column of the x of each point; y and z follow. */
  readonly columns: readonly number[];
}

interface Long {
  readonly kind: 'long';
  readonly frame: number;
  readonly time: number;
  readonly label: number;
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

/** The points of a table; undefined if its columns are other ones. @throws PointsError if a cell is no number */
export function readPointRows(bytes: Uint8Array, budget: Budget, remarks: Remarks): PointTable | undefined {
  const rows = new Rows(bytes, separatorOf(bytes));
  const names = rows.next() ? rows.texts() : [];
  const columns = longOf(names) ?? wideOf(names);
  if (!columns) return undefined;
  const read = columns.kind === 'wide' ? readWide(rows, columns, budget) : readLong(rows, columns, budget);
  const { times, steps, ...table } = read;
  const rate = times && rateOfTimes(times, steps);
  if (rate === undefined) {
    const why = table.frameCount > 1 ? 'Its times don’t rise.' : 'No rate follows from the time of one frame.';
    const message = times ? why : 'The table states no times.';
    remarks.tell('rate-assumed', message, `used ${USUAL_FRAMES_PER_SECOND} frames per second`);
  }
  return { ...table, framesPerSecond: rate ?? USUAL_FRAMES_PER_SECOND };
}

/** The one of which the first line has most. */
function separatorOf(bytes: Uint8Array): number {
  const counts = [COMMA, SEMICOLON, TAB].map((separator) => {
    const rows = new Rows(bytes, separator);
    return { separator, count: rows.next() ? rows.count : 0 };
  });
  return counts.reduce((most, one) => (one.count > most.count ? one : most)).separator;
}

function longOf(names: readonly string[]): Long | undefined {
  const column = (pattern: RegExp) => names.findIndex((name) => pattern.test(name));
  const [frame, time, label] = [FRAME, TIME, LABEL].map(column);
  const [x, y, z] = [/^x$/i, /^y$/i, /^z$/i].map(column);
  return Math.min(frame, label, x, y, z) < 0 ? undefined : { kind: 'long', frame, time, label, x, y, z };
}

function wideOf(names: readonly string[]): Wide | undefined {
  const isBefore = (name: string) => FRAME.test(name) || TIME.test(name);
  let first = 0;
  while (first < names.length && isBefore(names[first])) first++;
  if (first === 0) return undefined;
  const labels: string[] = [];
  const columns: number[] = [];
  for (let c = first; c < names.length; ) {
    const three = names.slice(c, c + 3).map((name) => COORDINATE.exec(name));
    const label = three[0]?.[1];
    const isPoint = three.length === 3 && three.every((found, k) => found?.[1] === label && isAxis(found?.[2], k));
    if (isPoint && label !== undefined) {
      labels.push(label);
      columns.push(c);
      c += 3;
    } else if (CONFIDENCE.test(names[c])) c++;
    else return undefined;
  }
  if (labels.length === 0) return undefined;
  const [frame, time] = [FRAME, TIME].map((pattern) => names.findIndex((name) => pattern.test(name)));
  return { kind: 'wide', frame, time, labels, columns };
}

function isAxis(letter: string | undefined, k: number): boolean {
  return letter?.toLowerCase() === 'xyz'[k];
}

/** Without a rate, and with what it follows from. */
interface ReadRows extends Omit<PointTable, 'framesPerSecond'> {
  /** Seconds of each frame, in order, if they are given. */
  readonly times?: Float64Array;
  /** Numbers of these frames. */
  readonly steps?: Float64Array;
}

function readWide(rows: Rows, { frame, time, labels, columns }: Wide, budget: Budget): ReadRows {
  const pointCount = labels.length;
  checkCount(pointCount);
  const most = Math.max(1, lineCount(rows.bytes) - rows.line);
  const values = roomFor(pointCount, most, budget);
  const times = new Float64Array(most);
  const numbers = new Float64Array(most);
  let frameCount = 0;
  let missing = 0;
  while (rows.next()) {
    if (rows.count === 0) continue;
    if (time >= 0) times[frameCount] = rows.number(time);
    numbers[frameCount] = frame >= 0 ? rows.numberOrNone(frame) : frameCount;
    const from = POINT_WIDTH * pointCount * frameCount;
    for (let p = 0; p < pointCount; p++) {
      const c = columns[p];
      if (!writePoint(rows, c, c + 1, c + 2, values, from + POINT_WIDTH * p)) missing++;
    }
    frameCount++;
  }
  if (frameCount === 0) withoutRows();
  const width = POINT_WIDTH * pointCount;
  const own = values.subarray(0, width * frameCount);
  const stated = numbers.subarray(0, frameCount);
  const { frameCount: count, frameOf } = framesOf(stated);
  if (count > frameCount && stated.every((number, row) => row === 0 || number > stated[row - 1])) {
    const spread = roomFor(pointCount, count, budget);
    const steps = stated.map(frameOf);
    steps.forEach((at, row) => {
      spread.set(own.subarray(width * row, width * (row + 1)), width * at);
    });
    holdMissing(spread, pointCount, count);
    const timed = time >= 0 && { times: times.subarray(0, frameCount), steps };
    return { labels: labelsFor(labels, pointCount), frameCount: count, values: spread, ...timed };
  }
  if (missing > 0) holdMissing(own, pointCount, frameCount);
  return {
    labels: labelsFor(labels, pointCount),
    frameCount,
    values: own.length < values.length ? own.slice() : values,
    ...(time >= 0 && { times: times.subarray(0, frameCount) }),
  };
}

function withoutRows(): never {
  return fail('frames-missing', 'Expected rows of numbers under the names of columns, found none.');
}

function checkCount(pointCount: number): void {
  if (pointCount > MAX_POINTS) fail('points-many', `Expected at most ${MAX_POINTS} points, found ${pointCount}.`);
}

/** Rows as they come: the frame and the label of each, by the index of that. */
interface LongRows {
  readonly count: number;
  readonly frames: Float64Array;
  readonly times: Float64Array;
  readonly points: Int32Array;
  readonly places: Float64Array;
  readonly labels: readonly string[];
}

function readLong(rows: Rows, columns: Long, budget: Budget): ReadRows {
  const read = longRows(rows, columns, budget);
  if (read.count === 0) withoutRows();
  const labels = inOrder(read.labels);
  const places = new Map(labels.map((label, p) => [label, p]));
  const index = Int32Array.from(read.labels, (label) => places.get(label) ?? 0);
  const pointCount = labels.length;
  const { frameCount, frameOf } = framesOf(read.frames.subarray(0, read.count));
  const values = roomFor(pointCount, frameCount, budget);
  const times = new Float64Array(frameCount).fill(Number.NaN);
  for (let row = 0; row < read.count; row++) {
    const frame = frameOf(read.frames[row]);
    if (Number.isNaN(times[frame])) times[frame] = read.times[row];
    const from = POINT_WIDTH * row;
    if (read.places[from + 3] === 0) continue;
    const to = POINT_WIDTH * (frame * pointCount + index[read.points[row]]);
    for (let k = 0; k < POINT_WIDTH; k++) values[to + k] = read.places[from + k];
  }
  holdMissing(values, pointCount, frameCount);
  const timed = Float64Array.from({ length: frameCount }, (_, f) => f).filter((f) => !Number.isNaN(times[f]));
  const isNumbered = pointCount === NUMBERED && labels.every((label, p) => label === String(p));
  return {
    labels: labelsFor(labels, pointCount),
    frameCount,
    values,
    ...(columns.time >= 0 && { times: Float64Array.from(timed, (f) => times[f]), steps: timed }),
    ...(isNumbered && { isNumbered }),
  };
}

function longRows(rows: Rows, { frame, time, label, x, y, z }: Long, budget: Budget): LongRows {
  const most = Math.max(1, lineCount(rows.bytes) - rows.line);
  const places = roomFor(1, most, budget);
  const frames = new Float64Array(most);
  const times = new Float64Array(most);
  const points = new Int32Array(most);
  const known = new Map<string, number>();
  const texts: Uint8Array[] = [];
  let count = 0;
  let expected = 0;
  while (rows.next()) {
    if (rows.count === 0) continue;
    frames[count] = rows.number(frame);
    times[count] = time < 0 ? Number.NaN : rows.number(time);
    // Labels come in the same order in each frame, so that most are not looked up.
    if (texts.length === 0 || !rows.isSame(label, texts[expected])) {
      const text = rows.text(label);
      if (text === '') fail('label-missing', 'Expected the label of a point, found none.', rows.place(label));
      expected = known.get(text) ?? texts.length;
      if (expected === texts.length) {
        checkCount(expected + 1);
        known.set(text, expected);
        texts.push(rows.bytesOf(label));
      }
    }
    points[count] = expected;
    expected = (expected + 1) % texts.length;
    writePoint(rows, x, y, z, places, POINT_WIDTH * count);
    count++;
  }
  return { count, frames, times, points, places, labels: [...known.keys()] };
}

/** Numbers by their size, names as they come. */
function inOrder(labels: readonly string[]): readonly string[] {
  const areNumbers = labels.every((label) => /^\d{1,9}$/.test(label));
  return areNumbers ? labels.toSorted((a, b) => Number(a) - Number(b)) : labels;
}

/** Frames that are left out are frames without points, unless so many are that the numbers must mean something else. */
const MAX_LEFT_OUT = 16;

function framesOf(numbers: Float64Array) {
  const distinct = Float64Array.from(new Set(numbers)).sort();
  const [first] = distinct;
  let step = 0;
  for (let i = 1; i < distinct.length; i++) step = commonDivisor(distinct[i] - distinct[i - 1], step);
  const count = step > 0 ? (distinct[distinct.length - 1] - first) / step + 1 : 1;
  if (distinct.every(Number.isSafeInteger) && count <= MAX_LEFT_OUT * distinct.length) {
    return { frameCount: count, frameOf: (number: number) => (step > 0 ? (number - first) / step : 0) };
  }
  const at = new Map(Array.from(distinct, (number, i) => [number, i]));
  return { frameCount: distinct.length, frameOf: (number: number) => at.get(number) ?? 0 };
}

function commonDivisor(a: number, b: number): number {
  let [x, y] = [a, b];
  while (y > 0) [x, y] = [y, x % y];
  return x;
}
