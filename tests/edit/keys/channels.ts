/** Channels for the tests of edits: written key by key, or made by fast-check. */
import fc from 'fast-check';
import { expect } from 'vitest';
import { compileChannels } from '../../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../src/evaluate/curves.ts';
import { keySlope } from '../../../src/evaluate/slopes.ts';
import {
  type Channel,
  EXTRAPOLATIONS,
  type Extrapolation,
  type KeyedChannel,
  keysOf,
  restChannel,
  type Tangents,
} from '../../../src/model/takes/take.ts';
import { FIXED_TANGENT, TANGENT_KINDS, type TangentKind } from '../../../src/model/takes/tangent-kinds.ts';
import { evenly } from '../dice.ts';

export type Tangent = Exclude<TangentKind, 'fixed'> | number;
/** Smooth on both sides by default; a single tangent is used for both. */
export type KeyRow = readonly [time: number, value: number, tangentIn?: Tangent, tangentOut?: Tangent];

export function channelOf(
  rows: readonly KeyRow[],
  before: Extrapolation = 'constant',
  after: Extrapolation = before,
): KeyedChannel {
  const column = (side: 'in' | 'out') => {
    const tangents = rows.map((row) => (side === 'in' ? row[2] : (row[3] ?? row[2])) ?? 'smooth');
    return {
      kinds: Uint8Array.from(tangents, (t) => (typeof t === 'number' ? FIXED_TANGENT : TANGENT_KINDS.indexOf(t))),
      slopes: Float64Array.from(tangents, (t) => (typeof t === 'number' ? t : 0)),
    };
  };
  return {
    kind: 'keys',
    extrapolateIn: before,
    extrapolateOut: after,
    times: Float64Array.from(rows, (r) => r[0]),
    values: Float64Array.from(rows, (r) => r[1]),
    tangentsIn: column('in'),
    tangentsOut: column('out'),
  };
}

/** The channel's keys as rows, every tangent written out: what `channelOf` takes. */
export function rowsOf(channel: Channel): KeyRow[] {
  const { times, values, tangentsIn, tangentsOut } = keysOf(channel);
  const written = ({ kinds, slopes }: Tangents, k: number) => {
    const kind = TANGENT_KINDS[kinds[k]];
    return kind === 'fixed' ? slopes[k] : kind;
  };
  return Array.from(times, (time, k) => [time, values[k], written(tangentsIn, k), written(tangentsOut, k)] as const);
}

/** Time and value of each key. */
export function pointsOf(channel: Channel): [number, number][] {
  const { times, values } = keysOf(channel);
  return Array.from(times, (time, k) => [time, values[k]]);
}

export function valueAt(channel: Channel, time: number): number {
  return evaluateChannel(compileChannels([channel]), 0, time);
}

/** Slope before and after a key. */
export function slopesAt(channel: KeyedChannel, key: number): [number, number] {
  return [keySlope(channel, key, 'in'), keySlope(channel, key, 'out')];
}

/** At most two keys at one time. */
export function expectNoCrowd(channel: Channel): void {
  const { times } = keysOf(channel);
  expect([...times].filter((time, k) => k > 1 && time === times[k - 2])).toEqual([]);
}

/** Mostly spread evenly; sometimes the extreme ones that `fc.double` likes, tiny numbers above all. */
export function between(min: number, max: number): fc.Arbitrary<number> {
  const even = evenly.map((u) => min + u * (max - min));
  return fc.oneof({ weight: 4, arbitrary: even }, { weight: 1, arbitrary: fc.double({ min, max, noNaN: true }) });
}

const tangent = fc.oneof(fc.constantFrom<Tangent[]>('flat', 'linear', 'smooth', 'auto'), between(-20, 20));
const value = fc.oneof(between(-100, 100), fc.integer({ min: -3, max: 3 }));

/**
 * Keys on eighths of seconds, from −25 to 25; with `steps` two may be at one time. Values repeat in some, so that there
 * are level and straight stretches.
 */
export function rows(minLength: number, { steps = false, maxLength = 10 } = {}): fc.Arbitrary<KeyRow[]> {
  return fc
    .uniqueArray(fc.integer({ min: -200, max: 200 }), { minLength, maxLength })
    .chain((ticks) =>
      fc.tuple(
        ...ticks
          .sort((a, b) => a - b)
          .map((tick) => {
            const row = fc.tuple(fc.constant(tick / 8), value, tangent, tangent);
            return steps ? fc.array(row, { minLength: 1, maxLength: 2, size: 'small' }) : row.map((r) => [r]);
          }),
      ),
    )
    .map((all) => all.flat());
}

export function channels(
  minLength: number,
  options: { steps?: boolean; maxLength?: number; extrapolations?: readonly Extrapolation[] } = {},
): fc.Arbitrary<KeyedChannel> {
  const extrapolation = fc.constantFrom(...(options.extrapolations ?? EXTRAPOLATIONS));
  return fc
    .tuple(rows(minLength, options), extrapolation, extrapolation)
    .map(([keys, before, after]) => channelOf(keys, before, after));
}

/** A channel of some keys, or at rest. */
export function channelsOrRest(options: Parameters<typeof channels>[1] = {}): fc.Arbitrary<Channel> {
  const extrapolation = fc.constantFrom(...(options.extrapolations ?? EXTRAPOLATIONS));
  const resting = fc
    .tuple(fc.constantFrom(0, 0.5), extrapolation, extrapolation)
    .map(([at, extrapolateIn, extrapolateOut]) => ({ ...restChannel(at), extrapolateIn, extrapolateOut }));
  return fc.oneof({ weight: 1, arbitrary: resting }, { weight: 8, arbitrary: channels(1, options) });
}

/** A channel, and some of its keys. */
export function withSome(channel: fc.Arbitrary<KeyedChannel>): fc.Arbitrary<{ channel: KeyedChannel; some: number[] }> {
  return channel.chain((c) =>
    fc.subarray([...c.times.keys()], { minLength: Math.min(1, c.times.length) }).map((some) => ({ channel: c, some })),
  );
}
