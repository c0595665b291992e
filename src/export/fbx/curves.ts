/** Curves as records: keys with times in ticks, values as floats, and the kind of each span. */
import { TICKS_PER_SECOND } from '../../formats/fbx/constants.ts';
import type { Extrapolation } from '../../model/takes/take.ts';
import type { Keys } from './dof-curves.ts';
import { array, double, type FbxBytes, type FbxOut, int, record, small } from './records.ts';

/** Kinds of spans. */
const HOLD = 0x2;
const LINE = 0x4;
/** With slopes of its own on both sides, which may differ. */
const CUBIC = 0x8 | 0x400 | 0x800;
const KEY_VERSION = 4008;
/** Seconds between the two keys of a step. */
const STEP_SECONDS = 1e-5;
/** Relative difference of values that is none. */
const SAME = 1e-9;

/** A time in ticks. */
export function ticksOf(seconds: number): number {
  return Math.round(seconds * TICKS_PER_SECOND);
}

/** The times of frames, which curves share, as they are in the file. */
export function frameTimes(seconds: readonly number[]): FbxBytes {
  return array(BigInt64Array.from(seconds, (time) => BigInt(ticksOf(time))));
}

/** The curve of a value for each frame: straight from one to the next, or held until it. */
export function frameCurve(times: FbxBytes, values: Float32Array<ArrayBuffer>, isHeld: boolean): readonly FbxOut[] {
  return curve(times, values, [{ flags: isHeld ? HOLD : LINE, right: 0, left: 0, count: values.length }]);
}

interface Run {
  readonly flags: number;
  /** Slope on the right of the key, and on the left of the next one. */
  readonly right: number;
  readonly left: number;
  count: number;
}

function curve(times: FbxBytes, values: Float32Array<ArrayBuffer>, runs: readonly Run[]): readonly FbxOut[] {
  const data = new Float32Array(4 * runs.length);
  const words = new DataView(data.buffer);
  runs.forEach(({ right, left }, i) => {
    data[4 * i] = right;
    data[4 * i + 1] = left;
    words.setUint32(16 * i + 8, THIRDS, true);
  });
  return [
    record('Default', [double(values[0])]),
    record('KeyVer', [int(KEY_VERSION)]),
    record('KeyTime', [times]),
    record('KeyValueFloat', [array(values)]),
    record('KeyAttrFlags', [array(Int32Array.from(runs, ({ flags }) => flags))]),
    record('KeyAttrDataFloat', [array(data)]),
    record('KeyAttrRefCount', [array(Int32Array.from(runs, ({ count }) => count))]),
  ];
}

/** Handles of a third, in ten thousandths, on both sides. */
const THIRDS = (3333 << 16) | 3333;

interface Key {
  readonly ticks: number;
  readonly value: number;
  flags: number;
  right: number;
  left: number;
}

/**
 * The curve of keys.
 * @param factor what values are multiplied by
 */
export function keyCurve(keys: Keys, factor: number): readonly FbxOut[] {
  const list = keyList(keys, factor);
  const runs: Run[] = [];
  for (const { flags, right, left } of list) {
    const last = runs[runs.length - 1];
    if (last && last.flags === flags && last.right === right && last.left === left) last.count++;
    else runs.push({ flags, right, left, count: 1 });
  }
  const times = array(BigInt64Array.from(list, ({ ticks }) => BigInt(ticks)));
  const values = Float32Array.from(list, ({ value }) => value);
  return [
    ...curve(times, values, runs),
    ...beyond('Pre-Extrapolation', keys.before),
    ...beyond('Post-Extrapolation', keys.after),
  ];
}

const MODES: { readonly [E in Exclude<Extrapolation, 'constant'>]: string } = {
  linear: 'K',
  cycle: 'R',
  cycle_offset: 'A',
  bounce: 'M',
};

function beyond(name: string, mode: Extrapolation): readonly FbxOut[] {
  if (mode === 'constant') return [];
  const letter = small(MODES[mode].charCodeAt(0));
  return [record(name, [], [record('Type', [letter]), record('Repetition', [int(-1)])])];
}

/** Keys whose times differ: what is held until a step has no key of its own there, and what moves until then a little before. */
function keyList({ times, values, slopesIn, slopesOut }: Keys, factor: number): readonly Key[] {
  const list: Key[] = [];
  const add = (seconds: number, value: number, flags: number, right: number) => {
    const ticks = ticksOf(seconds);
    const last = list[list.length - 1];
    if (last && ticks <= last.ticks) list.pop();
    list.push({ ticks, value: factor * value, flags, right: factor * right, left: 0 });
  };
  for (let k = 0; k < times.length; k++) {
    const isStep = k + 1 < times.length && times[k + 1] === times[k];
    const last = list[list.length - 1];
    // Of several keys at one time only the first and the last are seen.
    if (isStep && k > 0 && times[k - 1] === times[k]) continue;
    const h = k > 0 ? times[k] - times[k - 1] : 0;
    const changes = [values[k] - values[k - 1], h * slopesOut[k - 1], h * slopesIn[k]];
    const isFlat = h > 0 && changes.every((change) => Math.abs(change) <= SAME * Math.max(1, Math.abs(values[k])));
    if (last && h > 0) last.left = factor * slopesIn[k];
    if (!isStep) add(times[k], values[k], CUBIC, slopesOut[k]);
    else if (last && isFlat) last.flags = HOLD;
    else {
      const before = Math.min(STEP_SECONDS, (h || 1) / 2);
      add(times[k] - before, values[k] - before * (h > 0 ? slopesIn[k] : 0), HOLD, 0);
    }
  }
  return list.map((key) => (key.flags === HOLD ? { ...key, right: 0, left: 0 } : key));
}
