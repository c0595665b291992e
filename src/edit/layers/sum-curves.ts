/**
 * The exact sum of curves, each times a factor: keys at the union of their keys, with the summed values and slopes.
 *
 *     f₁·c₁    ●────────●──────●
 *     f₂·c₂       ●─────●━╸                 a jump stays two keys at one time
 *     sum      ●──●─────●━╸────●
 *
 * The sum of cubics between two keys is a cubic, so it is the same everywhere between the first and the last key.
 * Beyond these it is too where all curves continue alike; otherwise their repetitions are written out as keys over a
 * window first.
 */
import { type CompiledTake, compileChannels } from '../../evaluate/compiled-take.ts';
import { evaluateChannel, evaluateSlope } from '../../evaluate/curves.ts';
import { keySlope } from '../../evaluate/slopes.ts';
import { type Extrapolation, type KeyedChannel, NO_EXTRAPOLATION, repeats } from '../../model/takes/take.ts';
import { FIXED_TANGENT } from '../../model/takes/tangent-kinds.ts';
import { unrolled } from '../channels/bake-extrapolation.ts';
import { meets } from '../channels/sloped-key.ts';
import { type Key, tangent, withKeyList } from '../keys/columns.ts';

/** A curve times a factor. */
export interface Term {
  /** Not 0. */
  readonly factor: number;
  readonly channel: KeyedChannel;
}

/** A sum of curves as a channel. */
export interface Sum {
  readonly channel: KeyedChannel;
  /** Whether it is the same within the window only, since repetitions were written out. */
  readonly isBaked: boolean;
}

/**
 * The sum of curves and a constant, with `fixed` tangents.
 * @param terms at least one
 * @param range seconds that the window contains besides all keys
 * @throws CommandError if repetitions would take too many keys
 */
export function sumOfCurves(terms: readonly Term[], constant: number, range: readonly [number, number]): Sum {
  const moving: Term[] = [];
  let still = constant;
  for (const term of terms) {
    if (isStill(term.channel)) still += term.factor * term.channel.values[0];
    else moving.push(term);
  }
  if (moving.length === 0) {
    const time = Math.min(...terms.map(({ channel }) => channel.times[0]));
    return {
      channel: withKeyList(CONSTANT, [
        keyOf({ time, valueIn: still, valueOut: still, slopeIn: 0, slopeOut: 0 }, 'both'),
      ]),
      isBaked: false,
    };
  }
  const before = commonSide(moving, 'extrapolateIn');
  const after = commonSide(moving, 'extrapolateOut');
  if (before && after) {
    const sides = { ...CONSTANT, extrapolateIn: before, extrapolateOut: after };
    return { channel: withKeyList(sides, summedKeys(moving, still)), isBaked: false };
  }
  const [from, to] = windowOf(moving, range);
  const written = moving.map(({ factor, channel }) => ({ factor, channel: unrolled(channel, from, to) }));
  return { channel: withKeyList(CONSTANT, summedKeys(written, still)), isBaked: true };
}

const CONSTANT = { kind: 'rest', value: 0, ...NO_EXTRAPOLATION } as const;

/** Whether it has the value of its only key at all times. */
function isStill(channel: KeyedChannel): boolean {
  if (channel.times.length > 1) return false;
  const goesOn = (side: Extrapolation, slope: number) => side === 'linear' && slope !== 0;
  return (
    !goesOn(channel.extrapolateIn, keySlope(channel, 0, 'in')) &&
    !goesOn(channel.extrapolateOut, keySlope(channel, 0, 'out'))
  );
}

type Side = 'extrapolateIn' | 'extrapolateOut';

/** The extrapolation that gives the sum beyond its keys on one side; undefined if none does. */
function commonSide(terms: readonly Term[], side: Side): Extrapolation | undefined {
  const kinds = new Set(terms.map(({ channel }) => extrapolationOf(channel, side)));
  if (![...kinds].some(repeats)) return kinds.has('linear') ? 'linear' : 'constant';
  const [{ times }] = terms.map(({ channel }) => channel);
  const areOfOnePeriod = terms.every(
    ({ channel }) => channel.times[0] === times[0] && channel.times.at(-1) === times.at(-1),
  );
  if (!areOfOnePeriod) return undefined;
  if (kinds.size === 1) return [...kinds][0];
  const isOffset = ({ channel }: Term) => {
    const kind = extrapolationOf(channel, side);
    return kind === 'cycle_offset' || (kind === 'cycle' && channel.values[0] === channel.values.at(-1));
  };
  return terms.every(isOffset) ? 'cycle_offset' : undefined;
}

/** Without a period, repetitions are constant. */
function extrapolationOf(channel: KeyedChannel, side: Side): Extrapolation {
  const { times } = channel;
  const hasPeriod = times[times.length - 1] > times[0];
  return repeats(channel[side]) && !hasPeriod ? 'constant' : channel[side];
}

function windowOf(terms: readonly Term[], [start, end]: readonly [number, number]): readonly [number, number] {
  const firsts = terms.map(({ channel }) => channel.times[0]);
  const lasts = terms.map(({ channel }) => channel.times[channel.times.length - 1]);
  return [Math.min(start, ...firsts), Math.max(end, ...lasts)];
}

function summedKeys(terms: readonly Term[], still: number): readonly Key[] {
  const curves = terms.map(({ factor, channel }) => ({ factor, curve: new Curve(channel) }));
  return unionOfTimes(terms.map(({ channel }) => channel)).flatMap((time): readonly Key[] => {
    const sum = { time, valueIn: still, valueOut: still, slopeIn: 0, slopeOut: 0 };
    for (const { factor, curve } of curves) {
      const at = curve.at(time);
      sum.valueIn += factor * at.valueIn;
      sum.valueOut += factor * at.valueOut;
      sum.slopeIn += factor * at.slopeIn;
      sum.slopeOut += factor * at.slopeOut;
    }
    return keysAt(sum);
  });
}

/** A curve at a time, from both sides. */
export interface BothSides {
  /** Seconds of the take. */
  readonly time: number;
  readonly valueIn: number;
  readonly valueOut: number;
  /** Value per second. */
  readonly slopeIn: number;
  readonly slopeOut: number;
}

/** A key there, or two where the value jumps. */
export function keysAt(at: BothSides): readonly Key[] {
  return meets(at.valueIn, at.valueOut) ? [keyOf(at, 'both')] : [keyOf(at, 'in'), keyOf(at, 'out')];
}

function keyOf({ time, valueIn, valueOut, slopeIn, slopeOut }: BothSides, side: 'in' | 'out' | 'both'): Key {
  return {
    time,
    value: side === 'in' ? valueIn : valueOut,
    in: tangent(FIXED_TANGENT, side === 'out' ? 0 : slopeIn),
    out: tangent(FIXED_TANGENT, side === 'in' ? 0 : slopeOut),
  };
}

/** Times of copied keys differ by rounding from those that they meet. */
const SAME_TIME = 1e-12;

function isSameTime(a: number, b: number): boolean {
  return Math.abs(a - b) <= SAME_TIME * Math.max(1, Math.abs(a), Math.abs(b));
}

/** All times of keys, ascending, each once. */
export function unionOfTimes(channels: readonly KeyedChannel[]): readonly number[] {
  const all = Float64Array.from(channels.flatMap(({ times }) => [...times])).sort();
  const union: number[] = [];
  for (const time of all) if (union.length === 0 || !isSameTime(union[union.length - 1], time)) union.push(time);
  return union;
}

/** A channel evaluated at ascending times. */
export class Curve {
  private readonly compiled: CompiledTake;
  private next = 0;

  constructor(private readonly channel: KeyedChannel) {
    this.compiled = compileChannels([channel]);
  }

  /** Its values and slopes at a time that is not before the one asked for last. */
  at(time: number): BothSides {
    const { channel, compiled } = this;
    const { times, values } = channel;
    const last = times.length - 1;
    while (this.next <= last && times[this.next] < time && !isSameTime(times[this.next], time)) this.next++;
    const first = this.next;
    let end = first;
    while (end <= last && isSameTime(times[end], time)) end++;
    if (end === first) {
      const value = evaluateChannel(compiled, 0, time);
      const slope = evaluateSlope(compiled, 0, time, 'out');
      return { time, valueIn: value, valueOut: value, slopeIn: slope, slopeOut: slope };
    }
    const slopeIn = first === 0 && channel.extrapolateIn === 'constant' ? 0 : keySlope(channel, first, 'in');
    const slopeOut = end > last && channel.extrapolateOut === 'constant' ? 0 : keySlope(channel, end - 1, 'out');
    return { time, valueIn: values[first], valueOut: values[end - 1], slopeIn, slopeOut };
  }
}
