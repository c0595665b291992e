import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { documentIn } from '../../../src/edit/change.ts';
import { keyPose } from '../../../src/edit/commands/keying.ts';
import { addKey, insertKeys } from '../../../src/edit/commands/keys.ts';
import { pasteKeys } from '../../../src/edit/commands/paste.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { copyKeys } from '../../../src/edit/keys/clipboard.ts';
import { changedCycles, type OutsideCycle, period, placeOf, withRepeatsBaked } from '../../../src/edit/keys/cycle.ts';
import { putKeyAt } from '../../../src/edit/keys/put-key.ts';
import { type Document, shownTake } from '../../../src/model/document.ts';
import {
  type Channel,
  EXTRAPOLATIONS,
  type Extrapolation,
  type KeyedChannel,
  keysOf,
  repeats,
} from '../../../src/model/takes/take.ts';
import { SMOOTH } from '../../../src/model/takes/tangent-kinds.ts';
import { character, documentOf, joint } from '../../helpers/builders.ts';
import { expectEdit } from '../../helpers/expect-edit.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { between, channelOf, channels, valueAt } from './channels.ts';

const REPEATING = EXTRAPOLATIONS.filter(repeats);
/** Of the curve's largest value. */
const SHAPE = 1e-9;

const first = ({ times }: KeyedChannel) => times[0];
const last = ({ times }: KeyedChannel) => times[times.length - 1];
const sizeOf = ({ values, tangentsIn, tangentsOut, times }: KeyedChannel) => {
  const span = Math.max(1, last({ times } as KeyedChannel) - times[0]);
  const slope = Math.max(...[...tangentsIn.slopes, ...tangentsOut.slopes].map(Math.abs));
  return Math.max(1, ...[...values].map(Math.abs)) + slope * span;
};

/** At least what the curve rises in a second at its steepest. */
const steepest = ({ times, values, tangentsIn, tangentsOut }: KeyedChannel) => {
  const spans = [...times.keys()].slice(1).filter((k) => times[k] > times[k - 1]);
  const means = spans.map((k) => Math.abs(values[k] - values[k - 1]) / (times[k] - times[k - 1]));
  const ends = [...tangentsIn.slopes, ...tangentsOut.slopes].map(Math.abs);
  return 3 * (Math.max(...means) + Math.max(...ends));
};

/** Same values; beside a step, at which rounding may be on either side, the value of one of its sides. */
function expectSameCurve(after: Channel, before: KeyedChannel, times: readonly number[]): void {
  for (const time of times) {
    const own = Math.max(1, Math.abs(time)) * 1e-9;
    const meant = [time, time - own, time + own].map((t) => valueAt(before, t));
    const off = Math.min(...meant.map((value) => Math.abs(valueAt(after, time) - value)));
    const turns = 1 + Math.abs(time) / period(before);
    expect(off, `at ${time}`).toBeLessThanOrEqual(SHAPE * sizeOf(before) * turns + own * steepest(before));
  }
}

/** Keys on eighths, at least two, that repeat on one side at least. */
const looping = channels(2, { steps: true, maxLength: 6 }).filter(
  (c) => period(c) > 0 && (repeats(c.extrapolateIn) || repeats(c.extrapolateOut)),
);
const goesOnAlike = (c: KeyedChannel) =>
  !repeats(c.extrapolateIn) || !repeats(c.extrapolateOut) || c.extrapolateIn === c.extrapolateOut;
/** In periods after the first key: before the keys, among them and after them. */
const turnsAway = fc.array(between(-7, 7), { minLength: 8, maxLength: 20 });

describe('baked repetitions', () => {
  it('baked repetitions keep the curve at every time, before and after, and continue in the same way', () => {
    fc.assert(
      fc.property(looping.filter(goesOnAlike), between(-4, 4), between(-4, 4), turnsAway, (channel, a, b, at) => {
        const length = period(channel);
        const [from, to] = [a, b].sort((x, y) => x - y).map((turns) => first(channel) + turns * length);
        const baked = withRepeatsBaked(channel, from, to);
        checkChannel(baked);
        expect([baked.extrapolateIn, baked.extrapolateOut]).toEqual([channel.extrapolateIn, channel.extrapolateOut]);
        expectSameCurve(
          baked,
          channel,
          at.map((turns) => first(channel) + turns * length),
        );
      }),
    );
  });

  it('baked repetitions keep the curve between their ends if it continues in two different ways', () => {
    fc.assert(
      fc.property(looping, between(-4, 0), between(1, 5), fc.array(between(0, 1), { maxLength: 20 }), (c, a, b, at) => {
        const [from, to] = [a, b].map((turns) => first(c) + turns * period(c));
        const baked = withRepeatsBaked(c, from, to);
        const reach = last(baked) - first(baked);
        expectSameCurve(
          baked,
          c,
          at.map((share) => first(baked) + share * reach),
        );
        if (repeats(c.extrapolateIn)) expect(first(baked)).toBeLessThanOrEqual(from + 1e-6);
        if (repeats(c.extrapolateOut)) expect(last(baked)).toBeGreaterThanOrEqual(to - 1e-6);
      }),
    );
  });

  it('baked repetitions are whole ones, and none where the keys reach far enough', () => {
    const walk = channelOf(
      [
        [0, 0],
        [0.5, 1],
        [1, 0],
      ],
      'cycle',
    );
    expect([...withRepeatsBaked(walk, 0, 2.2).times]).toEqual([0, 0.5, 1, 1.5, 2, 2.5, 3]);
    expect(last(withRepeatsBaked(walk, 0, 0.1 * 30))).toBe(3);
    expect(withRepeatsBaked(walk, 0, 1)).toBe(walk);
    expect(
      withRepeatsBaked(
        channelOf(
          [
            [0, 0],
            [1, 1],
          ],
          'linear',
        ),
        -9,
        9,
      ).times,
    ).toHaveLength(2);
  });
});

describe('a key inside the cycle', () => {
  it('gives the value at the time that was asked for, and keeps the period', () => {
    fc.assert(
      fc.property(
        channels(2, { maxLength: 6, extrapolations: REPEATING }),
        between(-5, 5),
        between(-50, 50),
        (channel, turns, value) => {
          const time = first(channel) + turns * period(channel);
          const { channel: keyed, index } = putKeyAt(channel, time, value, SMOOTH, { outsideCycle: 'inside' });
          checkChannel(keyed);
          expect(period(keyed)).toBe(period(channel));
          expect(index).toBeGreaterThanOrEqual(0);
          // Nearer to a seam than times are told apart, the other side of it may be meant.
          const own = Math.max(1, Math.abs(time)) * 3e-9;
          const found = [time, time - own, time + own].map((t) => Math.abs(valueAt(keyed, t) - value));
          expect(Math.min(...found)).toBeLessThanOrEqual(1e-6 * sizeOf(keyed));
        },
      ),
    );
  });

  it.each([
    ['cycle', 2.25, 0.25, 0],
    ['cycle_offset', 2.25, 0.25, 4],
    ['cycle_offset', -0.75, 0.25, -2],
    ['bounce', 2.25, 0.25, 0],
    ['bounce', 1.25, 0.75, 0],
    ['bounce', -0.25, 0.25, 0],
    ['cycle', 3, 0, 0],
    ['bounce', 3, 1, 0],
  ] as const)('is put by %s from %f s to %f s, %f lower', (way, asked, time, offset) => {
    const channel = channelOf(
      [
        [0, 0],
        [1, 2],
      ],
      way,
    );
    expect(placeOf(channel, asked, { outsideCycle: 'inside' })).toMatchObject({ channel, time, offset });
  });

  it('moves both ends of a loop when put on its seam', () => {
    const loop = channelOf(
      [
        [0, 1],
        [0.5, 3],
        [1, 1],
      ],
      'cycle',
    );
    expect([...putKeyAt(loop, 4, 2, SMOOTH, { outsideCycle: 'inside' }).channel.values]).toEqual([2, 3, 2]);
    const climb = channelOf(
      [
        [0, 1],
        [0.5, 3],
        [1, 2],
      ],
      'cycle_offset',
    );
    const put = putKeyAt(climb, 4, 6, SMOOTH, { outsideCycle: 'inside' }).channel;
    expect([...put.values]).toEqual([2, 3, 3]);
    expect(valueAt(put, 4)).toBe(6);
  });

  it('a key at an end of a closed loop changes both ends, so that no repetition jumps', () => {
    const keys = [
      [0, 1],
      [0.5, 3],
      [1, 1],
    ] as const;
    const keyed = (way: Extrapolation, time: number) => [
      ...putKeyAt(channelOf(keys, way), time, 2, SMOOTH, {}).channel.values,
    ];
    expect(keyed('cycle', 0)).toEqual([2, 3, 2]);
    expect(keyed('cycle', 1)).toEqual([2, 3, 2]);
    expect(keyed('cycle', 0.5)).toEqual([1, 2, 1]);
    for (const way of ['constant', 'linear', 'bounce', 'cycle_offset'] as const) {
      expect(keyed(way, 0)).toEqual([2, 3, 1]);
      expect(keyed(way, 1)).toEqual([1, 3, 2]);
    }
    // One that jumps already was meant to.
    const saw = channelOf(
      [
        [0, 0],
        [1, 5],
      ],
      'cycle',
    );
    expect([...putKeyAt(saw, 0, 2, SMOOTH, {}).channel.values]).toEqual([2, 5]);
  });

  it('a key inside the cycle is baked on a side that does not repeat, whose times have no phase in the cycle', () => {
    const channel = channelOf(
      [
        [0, 0],
        [1, 2],
      ],
      'constant',
      'cycle',
    );
    const place = placeOf(channel, -1, { outsideCycle: 'inside', bakedRange: [0, 3] });
    expect(place).toMatchObject({ time: -1, isFolded: false });
    expect(last(place.channel)).toBe(3);
  });
});

describe('which cycles change', () => {
  const takeOf = (...all: Channel[]) => ({ channels: all });
  const put = (channel: Channel, time: number) => putKeyAt(channel, time, 0, SMOOTH, {}).channel;
  const walk = (way: Extrapolation) =>
    channelOf(
      [
        [0, 0],
        [1, 1],
      ],
      way,
    );

  it('names those that repeat, with their periods, and the key that ends the new one', () => {
    const all = EXTRAPOLATIONS.map(walk);
    const found = (time: number) => changedCycles(takeOf(...all), takeOf(...all.map((c) => put(c, time))));
    const ways = (time: number) => found(time).map(({ channel }) => EXTRAPOLATIONS[channel]);
    expect(ways(2)).toEqual(REPEATING);
    expect(found(2)[0]).toEqual({ channel: 2, from: 1, to: 2, timeSeconds: 2 });
    expect(found(-1)[0]).toEqual({ channel: 2, from: 1, to: 2, timeSeconds: -1 });
    for (const inside of [0, 0.5, 1, 1 + 1e-12]) expect(found(inside)).toEqual([]);
  });

  it('names none of a single key, which has no cycle yet', () => {
    const lone = channelOf([[0, 0]], 'cycle');
    expect(changedCycles(takeOf(lone), takeOf(put(lone, 2)))).toEqual([]);
  });
});

describe('every command that adds keys', () => {
  const loop = channelOf(
    [
      [0, 0],
      [0.5, 1],
      [1, 0],
    ],
    'cycle',
  );
  const hero = character({
    skeleton: { name: 'hero', joints: [joint(-1, { name: 'hip' })] },
    takes: [{ name: 'walk', range: [0, 4], channels: Array.from({ length: 6 }, () => loop) }],
    shownTake: 0,
    timeOffsetSeconds: 0.25,
  });
  const document = documentOf(hero);
  const WHO = { characterId: 'c1' };
  const copied = copyKeys(
    {
      name: 'x',
      range: [0, 1],
      channels: [
        channelOf([
          [0, 5],
          [0.25, 7],
        ]),
      ],
    },
    [{ channel: 0, indices: [0, 1] }],
  );
  const bakedRange = [0, 4] as const;
  const key = (outsideCycle: OutsideCycle) => ({ outsideCycle, playedRange: [-0.25, 3.75] as const });
  const made: Readonly<Record<string, (outsideCycle: OutsideCycle) => Document>> = {
    'pose.key': (how) => expectEdit(document, keyPose, { ...WHO, dofs: [3], timeSeconds: 2, ...key(how) }),
    'pose.setDofs': (how) =>
      expectEdit(document, setDofs, { ...WHO, dofs: [{ index: 3, value: 0.5 }], timeSeconds: 2, key: key(how) }),
    'keys.insert': (outsideCycle) =>
      expectEdit(document, insertKeys, { ...WHO, channels: [3], timeSeconds: 2.25, outsideCycle, bakedRange }),
    'keys.add': (outsideCycle) =>
      expectEdit(document, addKey, { ...WHO, channel: 3, timeSeconds: 2.25, value: 0.5, outsideCycle, bakedRange }),
    'keys.paste': (outsideCycle) =>
      documentIn(
        pasteKeys.run(document, {
          ...WHO,
          copied,
          into: [3],
          timeSeconds: 2.25,
          mode: 'merge',
          outsideCycle,
          bakedRange,
        }),
      ),
  };
  const channelAfter = (after: Document) => shownTake(after.characters[0])?.channels[3] ?? loop;

  it.each(Object.keys(made))('%s bakes the played range, keys inside the cycle or lengthens it', (id) => {
    const [baked, inside, longer] = (['bake', 'inside', 'lengthen'] as const).map((how) => channelAfter(made[id](how)));
    expect(period(baked)).toBe(4);
    expect([...keysOf(baked).times]).toContain(2.25);
    expect(period(inside)).toBe(1);
    expect([...keysOf(inside).times]).toContain(0.25);
    expect(period(longer)).toBe(id === 'keys.paste' ? 2.5 : 2.25);
    for (const channel of [baked, inside]) {
      expect(valueAt(channel, 2.25)).toBeCloseTo(valueAt(longer, 2.25), 12);
      // Two keys off it is the walk still.
      expect(valueAt(baked, 3.25)).toBeCloseTo(valueAt(loop, 0.25), 12);
    }
    const others = (after: Document) => shownTake(after.characters[0])?.channels.filter((c) => c === loop);
    expect(others(made[id]('bake'))).toHaveLength(5);
  });

  it('keys on the curve keep the curve, baked or inside', () => {
    for (const how of ['bake', 'inside'] as const) {
      const times = [-0.3, 0.1, 0.8, 1.7, 2.2, 2.9, 5.6];
      expectSameCurve(channelAfter(made['keys.insert'](how)), loop, times);
    }
  });

  it('refuses unknown words for their placing', () => {
    const wrong = { ...WHO, channels: [3], timeSeconds: 2 };
    expect(() => insertKeys.run(document, { ...wrong, outsideCycle: 'elsewhere' as OutsideCycle })).toThrow(
      '"outsideCycle"',
    );
    expect(() => insertKeys.run(document, { ...wrong, bakedRange: [2, 1] })).toThrow('"bakedRange"');
  });
});
