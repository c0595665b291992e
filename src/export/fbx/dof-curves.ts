/**
 * Sums of DOFs over the time of a take as keys: between two breaks, where any of their channels has a key or a limit
 * begins to hold, a sum is one cubic, so that keys with its slopes there are exact.
 *
 *     DOF = clamp(gain · channel + offset)        limits and linked DOFs, however long the chain
 */
import { type CompiledTake, compileTake } from '../../evaluate/compiled-take.ts';
import { evaluateChannel } from '../../evaluate/curves.ts';
import type { CompiledSkeleton } from '../../evaluate/kinematics.ts';
import { keySlope } from '../../evaluate/slopes.ts';
import type { Character } from '../../model/document.ts';
import { type Extrapolation, type KeyedChannel, repeats, type Take } from '../../model/takes/take.ts';
import type { Sum, Term } from './node-rules.ts';

/** A curve as columns. Two keys at one time are a step. */
export interface Keys {
  readonly times: ArrayLike<number>;
  readonly values: ArrayLike<number>;
  readonly slopesIn: ArrayLike<number>;
  readonly slopesOut: ArrayLike<number>;
  /** What is before and after the keys; anything but `constant` only where the file says so instead of keys. */
  readonly before: Extrapolation;
  readonly after: Extrapolation;
}

/** What drives a sum: nothing that moves, keys only, or samples. */
type Drive = 'constant' | 'keys' | 'samples';

/** A DOF by the channel that it follows. */
interface Follow {
  /** Index of the channel; -1 for none. */
  readonly channel: number;
  readonly gain: number;
  readonly offset: number;
  readonly least: number;
  readonly most: number;
}

/** Spans that are shorter, in seconds, are none. */
const SHORTEST = 1e-7;
/** Keys of a curve that is written out beyond its keys, at most: for each of its own, and besides. */
const PER_KEY = 4;
const SPARE = 8;

/** The DOFs of a character in a take that nothing but its channels drives. */
export class DofCurves {
  private readonly compiled: CompiledTake;
  private readonly follows = new Map<number, Follow>();

  constructor(
    private readonly character: Character,
    private readonly skeleton: CompiledSkeleton,
    private readonly take: Take,
  ) {
    this.compiled = compileTake(take);
  }

  /** Says whether samples drive a sum, or keys only, or nothing that moves. */
  driveOf({ terms }: Sum): Drive {
    const kinds = terms.map((term) => this.kindOf(term));
    if (kinds.includes('samples')) return 'samples';
    return kinds.includes('keys') ? 'keys' : 'constant';
  }

  private kindOf({ dof }: Term): 'samples' | 'keys' | 'rest' {
    const { channel } = this.follow(dof);
    return this.take.channels[channel]?.kind ?? 'rest';
  }

  /** How a DOF follows a channel, through linked DOFs and limits. */
  private follow(dof: number): Follow {
    const known = this.follows.get(dof);
    if (known) return known;
    const { skeleton, character, take } = this;
    const { couples, lower, upper, firstDof } = skeleton;
    const at = dof - firstDof[0];
    const limit = (value: Follow): Follow =>
      character.clampsToLimits && at >= 0 && at < skeleton.dofCount ? clamped(value, lower[at], upper[at]) : value;
    const couple = couples.find((one) => one.dof === dof);
    const made = couple
      ? limit(scaled(this.follow(couple.follows), couple.gain, couple.offset))
      : dof < take.channels.length
        ? limit({ channel: dof, gain: 1, offset: 0, ...UNBOUNDED })
        : limit({ channel: -1, gain: 0, offset: character.pose[dof] ?? 0, ...UNBOUNDED });
    this.follows.set(dof, made);
    return made;
  }

  /** A sum at a time. */
  valueAt({ constant, terms }: Sum, seconds: number): number {
    return terms.reduce((sum, { dof, gain }) => sum + gain * this.dofAt(this.follow(dof), seconds), constant);
  }

  private dofAt({ channel, gain, offset, least, most }: Follow, seconds: number): number {
    const own = channel < 0 ? 0 : gain * evaluateChannel(this.compiled, channel, seconds);
    return Math.min(most, Math.max(least, own + offset));
  }

  /** The keys of a sum that keys drive. */
  keysOf(sum: Sum): Keys {
    const channels = this.channelsOf(sum);
    const [start, end] = this.take.range;
    const first = Math.min(...channels.map(({ times }) => times[0]));
    const last = Math.max(...channels.map(({ times }) => times[times.length - 1]));
    const isBefore = start < first && channels.some(({ extrapolateIn }) => extrapolateIn !== 'constant');
    const isAfter = end > last && channels.some(({ extrapolateOut }) => extrapolateOut !== 'constant');
    const plain = channels.flatMap(({ times }) => [...times]);
    const span = [first, last] as const;
    const stated = this.stated(sum, channels);
    if (!isBefore && !isAfter) return this.between(sum, plain, span, stated);
    const most = PER_KEY * plain.length + SPARE;
    const canState = (!isBefore || stated.before !== 'constant') && (!isAfter || stated.after !== 'constant');
    const periods = channels.reduce((all, { times }) => all + periodsIn(times, start, end) * times.length, 0);
    // So many that they need not be listed to be too many.
    if (canState && periods > most) return this.between(sum, plain, span, stated);
    const more = channels.flatMap((one) => repeated(one, start, end));
    const out = this.between(sum, [...plain, start, end, ...more], span, NO_EXTRAPOLATION);
    return out.times.length > most && canState ? this.between(sum, plain, span, stated) : out;
  }

  private channelsOf({ terms }: Sum): readonly KeyedChannel[] {
    const indices = new Set(terms.map(({ dof }) => this.follow(dof).channel));
    return [...indices].flatMap((c) => {
      const channel = this.take.channels[c];
      return channel?.kind === 'keys' ? [channel] : [];
    });
  }

  /** What a file may state about what is beyond the keys, because it means the same there. */
  private stated({ terms }: Sum, channels: readonly KeyedChannel[]): Beyond {
    const [one, ...others] = channels;
    const span = [one.times[0], one.times[one.times.length - 1]];
    const isOne = others.every(
      ({ times, extrapolateIn, extrapolateOut }) =>
        times[0] === span[0] &&
        times[times.length - 1] === span[1] &&
        extrapolateIn === one.extrapolateIn &&
        extrapolateOut === one.extrapolateOut,
    );
    if (!isOne || !(span[1] > span[0])) return NO_EXTRAPOLATION;
    const isLimited = terms.some(({ dof }) => {
      const { least, most } = this.follow(dof);
      return least > -Infinity || most < Infinity;
    });
    const last = one.times.length - 1;
    const isSmooth = (key: number) =>
      channels.every((channel) => {
        const k = key === 0 ? 0 : channel.times.length - 1;
        return keySlope(channel, k, 'in') === keySlope(channel, k, 'out');
      });
    const allowed = (mode: Extrapolation, key: number) =>
      mode === 'linear' ? !isLimited && isSmooth(key) : mode !== 'cycle_offset' || !isLimited;
    return {
      before: allowed(one.extrapolateIn, 0) ? one.extrapolateIn : 'constant',
      after: allowed(one.extrapolateOut, last) ? one.extrapolateOut : 'constant',
    };
  }

  /**
   * Keys at given times, and where limits begin and cease to hold between them.
   * @param span from the first to the last key of the take: others are left out where nothing changes
   */
  private between(sum: Sum, times: readonly number[], span: readonly [number, number], beyond: Beyond): Keys {
    const breaks = distinct(times);
    const cut = breaks.flatMap((a, i) => (i + 1 < breaks.length ? [a, ...this.crossings(sum, a, breaks[i + 1])] : [a]));
    const list = new SpanKeys();
    if (cut.length === 1) list.point(cut[0], this.valueAt(sum, cut[0]));
    for (let i = 0; i + 1 < cut.length; i++) {
      const [a, b] = [cut[i], cut[i + 1]];
      list.add(
        a,
        b,
        cubicOf((t) => this.valueAt(sum, t), a, b),
      );
    }
    // A step at the very end: what it is from there on.
    if (cut.length > 1) list.end(cut[cut.length - 1], this.valueAt(sum, cut[cut.length - 1]));
    return { ...list.columns(span), ...beyond };
  }

  /** Times within a span at which a limit begins or ceases to hold. */
  private crossings({ terms }: Sum, a: number, b: number): readonly number[] {
    const found = terms.flatMap(({ dof }) => {
      const { channel, gain, offset, least, most } = this.follow(dof);
      if (channel < 0 || (least === -Infinity && most === Infinity)) return [];
      const cubic = cubicOf((t) => gain * evaluateChannel(this.compiled, channel, t) + offset, a, b);
      return [least, most].filter(Number.isFinite).flatMap((value) => rootsOf(cubic, value, b - a));
    });
    return distinct(found.map((since) => a + since).filter((t) => t - a > SHORTEST && b - t > SHORTEST));
  }
}

const UNBOUNDED = { least: Number.NEGATIVE_INFINITY, most: Number.POSITIVE_INFINITY };

interface Beyond {
  readonly before: Extrapolation;
  readonly after: Extrapolation;
}

const NO_EXTRAPOLATION: Beyond = { before: 'constant', after: 'constant' };

function clamped(follow: Follow, least: number, most: number): Follow {
  const clamp = (value: number) => Math.min(most, Math.max(least, value));
  return { ...follow, least: clamp(follow.least), most: clamp(follow.most) };
}

function scaled({ channel, gain, offset, least, most }: Follow, by: number, plus: number): Follow {
  if (by === 0) return { channel: -1, gain: 0, offset: plus, ...UNBOUNDED };
  const [a, b] = [least * by + plus, most * by + plus];
  return { channel, gain: gain * by, offset: offset * by + plus, least: Math.min(a, b), most: Math.max(a, b) };
}

/** Repetitions of keys that a range covers beyond them. */
function periodsIn(times: Float64Array, start: number, end: number): number {
  const [first, last] = [times[0], times[times.length - 1]];
  const length = last - first;
  return length > 0 ? Math.max(0, first - start) / length + Math.max(0, end - last) / length : 0;
}

/** Times of the repeated keys within a range. */
function repeated({ times, extrapolateIn, extrapolateOut }: KeyedChannel, start: number, end: number): number[] {
  const [first, last] = [times[0], times[times.length - 1]];
  const length = last - first;
  if (!(length > 0)) return [];
  const from = repeats(extrapolateIn) ? Math.min(0, Math.floor((start - first) / length)) : 0;
  const to = repeats(extrapolateOut) ? Math.max(0, Math.ceil((end - last) / length)) : 0;
  const found: number[] = [];
  for (let period = from; period <= to; period++) {
    if (period === 0) continue;
    const isBack = (period < 0 ? extrapolateIn : extrapolateOut) === 'bounce' && period % 2 !== 0;
    for (const time of times) {
      const at = first + period * length + (isBack ? last - time : time - first);
      if (at > start && at < end) found.push(at);
    }
  }
  return found;
}

/** In ascending order, those that are nearer than the shortest span once. */
function distinct(times: readonly number[]): number[] {
  const sorted = [...times].sort((a, b) => a - b);
  const out: number[] = [];
  for (const time of sorted) if (out.length === 0 || time - out[out.length - 1] > SHORTEST) out.push(time);
  return out;
}

/** a + b·τ + c·τ² + d·τ³ in the time since the start of a span. */
type Cubic = readonly [number, number, number, number];

/** The cubic that a function is between two times, from inside, since it may jump at both. */
function cubicOf(value: (seconds: number) => number, start: number, end: number): Cubic {
  const h = end - start;
  const [p, q, r, s] = [1, 3, 5, 7].map((part) => value(start + (h * part) / 8));
  // By divided differences, in steps of a quarter.
  const [d1, d2, d3] = [q - p, (r - 2 * q + p) / 2, (s - 3 * r + 3 * q - p) / 6];
  const x0 = -0.5;
  // Newton's form in u = 4·τ/h − ½: p + d1·u + d2·u·(u−1) + d3·u·(u−1)·(u−2).
  const a = p + d1 * x0 + d2 * x0 * (x0 - 1) + d3 * x0 * (x0 - 1) * (x0 - 2);
  const b = d1 + d2 * (2 * x0 - 1) + d3 * (3 * x0 * x0 - 6 * x0 + 2);
  const c = d2 + d3 * (3 * x0 - 3);
  const k = 4 / h;
  return [a, b * k, c * k * k, d3 * k * k * k];
}

function valueIn([a, b, c, d]: Cubic, since: number): number {
  return ((d * since + c) * since + b) * since + a;
}

function slopeIn([, b, c, d]: Cubic, since: number): number {
  return (3 * d * since + 2 * c) * since + b;
}

/** From any span to the last digit. */
const BISECTIONS = 60;

/** Where a cubic has a value, between 0 and `h`: bisected between its turning points. */
function rootsOf(cubic: Cubic, value: number, h: number): readonly number[] {
  const [, b, c, d] = cubic;
  const square = c * c - 3 * d * b;
  const turns: number[] = [];
  if (square >= 0) {
    const q = -(c + Math.sign(c || 1) * Math.sqrt(square));
    for (const t of [q / (3 * d), b / q]) if (t > 0 && t < h) turns.push(t);
  }
  const stops = [0, ...turns.sort((x, y) => x - y), h];
  const off = (t: number) => valueIn(cubic, t) - value;
  return stops.slice(1).flatMap((to, i) => {
    let [low, high] = [stops[i], to];
    const isBelow = off(low) < 0;
    if (isBelow === off(high) < 0) return [];
    for (let step = 0; step < BISECTIONS; step++) {
      const middle = (low + high) / 2;
      if (off(middle) < 0 === isBelow) low = middle;
      else high = middle;
    }
    return [(low + high) / 2];
  });
}

/** Relative difference of values, or of slopes over a span, that is none. */
const SAME = 1e-9;

/** Collects cubics one after the other as keys. */
class SpanKeys {
  private readonly times: number[] = [];
  private readonly values: number[] = [];
  private readonly slopesIn: number[] = [];
  private readonly slopesOut: number[] = [];

  point(time: number, value: number, slopeIn = 0, slopeOut = 0): void {
    this.times.push(time);
    this.values.push(value);
    this.slopesIn.push(slopeIn);
    this.slopesOut.push(slopeOut);
  }

  add(start: number, end: number, cubic: Cubic): void {
    const h = end - start;
    const last = this.values.length - 1;
    const [v0, v1] = [valueIn(cubic, 0), valueIn(cubic, h)];
    if (last >= 0 && isNear(this.values[last], v0)) this.slopesOut[last] = slopeIn(cubic, 0);
    else this.point(start, v0, 0, slopeIn(cubic, 0));
    this.point(end, v1, slopeIn(cubic, h), 0);
  }

  /** What holds from the last time on. */
  end(time: number, value: number): void {
    if (!isNear(this.values[this.values.length - 1], value)) this.point(time, value);
  }

  /** All keys but those before and after a span that hold what their neighbour says. */
  columns([first, last]: readonly [number, number]): Omit<Keys, 'before' | 'after'> {
    const { times, values, slopesIn, slopesOut } = this;
    let [from, to] = [0, times.length];
    const isFlat = (k: number) =>
      isNear(values[k], values[k + 1]) &&
      [slopesOut[k], slopesIn[k + 1]].every((slope) =>
        isNear(values[k] + slope * (times[k + 1] - times[k]), values[k]),
      );
    while (times[from] < first && isFlat(from)) from++;
    while (times[to - 1] > last && isFlat(to - 2)) to--;
    const own = (column: readonly number[]) => column.slice(from, to);
    return { times: own(times), values: own(values), slopesIn: own(slopesIn), slopesOut: own(slopesOut) };
  }
}

function isNear(a: number, b: number): boolean {
  return Math.abs(a - b) <= SAME * Math.max(1, Math.abs(a), Math.abs(b));
}
