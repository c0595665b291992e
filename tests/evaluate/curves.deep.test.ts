import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileChannels, compileTake, provideReuse } from '../../src/evaluate/compiled-take.ts';
import { evaluateChannel, evaluateTake } from '../../src/evaluate/curves.ts';
import { RECOMPILED } from '../../src/evaluate/recompiled-take.ts';
import { resolvedSlopes } from '../../src/evaluate/slopes.ts';
import {
  type Channel,
  EXTRAPOLATIONS,
  type Extrapolation,
  type KeyedChannel,
  keysOf,
  restChannel,
} from '../../src/model/takes/take.ts';
import { FIXED_TANGENT, TANGENT_KINDS } from '../../src/model/takes/tangent-kinds.ts';
import { expectClose } from '../helpers/close.ts';
import { expectEqual } from '../helpers/equal.ts';
import { referenceTake } from '../helpers/reference.ts';
import { conformance, describeShared } from '../helpers/shared.ts';

type Tangent = 'flat' | 'linear' | 'smooth' | number;
type Key = readonly [time: number, value: number, tangentIn?: Tangent, tangentOut?: Tangent];

function channel(
  keys: readonly Key[],
  before: Extrapolation = 'constant',
  after: Extrapolation = before,
): KeyedChannel {
  const tangents = (side: 2 | 3) => ({
    kinds: Uint8Array.from(keys, (k) => {
      const tangent = k[side] ?? 'smooth';
      return typeof tangent === 'number' ? FIXED_TANGENT : TANGENT_KINDS.indexOf(tangent);
    }),
    slopes: Float64Array.from(keys, (k) => (typeof k[side] === 'number' ? k[side] : 0)),
  });
  return {
    kind: 'keys',
    extrapolateIn: before,
    extrapolateOut: after,
    times: Float64Array.from(keys, (k) => k[0]),
    values: Float64Array.from(keys, (k) => k[1]),
    tangentsIn: tangents(2),
    tangentsOut: tangents(3),
  };
}

const at = (c: Channel, time: number) => evaluateChannel(compileChannels([c]), 0, time);
const curve = (c: Channel) => {
  const compiled = compileChannels([c]);
  return (time: number) => evaluateChannel(compiled, 0, time);
};

interface Samples {
  readonly times: readonly number[];
  readonly values: readonly number[];
  readonly alternatives: Readonly<Record<string, number>>;
}
interface ChannelsFile {
  readonly tolerance: { readonly float64: number };
  readonly files: readonly {
    readonly anim: string;
    readonly range: readonly [number, number];
    readonly numchannels: number;
    readonly channels: readonly (Samples & { readonly index: number; readonly key_count: number })[];
  }[];
  readonly synthetic: readonly (Samples & {
    readonly name: string;
    readonly extrapolate: readonly [Extrapolation, Extrapolation];
    readonly keys: readonly [number, number, Tangent, Tangent][];
  })[];
}

function expectSamples(evaluate: (time: number) => number, samples: Samples, tolerance: number, what: string): void {
  const got = samples.times.map(evaluate);
  const expected = samples.values.map((value, i) => {
    const other = samples.alternatives[i];
    return other !== undefined && Math.abs(got[i] - other) < Math.abs(got[i] - value) ? other : value;
  });
  expectClose(got, expected, tolerance, what);
}

describeShared('channels against the reference', () => {
  const file = conformance<ChannelsFile>('channels.json');

  it.each(file.files)(
    'channels of $anim have the values of the reference',
    ({ anim, range, numchannels, channels }) => {
      const take = referenceTake(anim);
      expect(take.range).toEqual(range);
      expect(take.channels).toHaveLength(numchannels);
      const compiled = compileTake(take);
      for (const samples of channels) {
        expect(keysOf(take.channels[samples.index]).times).toHaveLength(samples.key_count);
        const evaluate = (t: number) => evaluateChannel(compiled, samples.index, t);
        expectSamples(evaluate, samples, file.tolerance.float64, `channel ${samples.index}`);
      }
    },
  );

  it.each(file.synthetic)('a channel of $name has the values of the reference', (samples) => {
    const evaluate = curve(channel(samples.keys, ...samples.extrapolate));
    expectSamples(evaluate, samples, file.tolerance.float64, samples.name);
  });

  it('gives the value of the period that starts at a boundary, never the alternative', () => {
    for (const samples of file.synthetic) {
      const evaluate = curve(channel(samples.keys, ...samples.extrapolate));
      expectClose(samples.times.map(evaluate), samples.values, file.tolerance.float64, samples.name);
    }
  });
});

const time = fc.double({ min: -50, max: 50, noNaN: true });
const value = fc.double({ min: -100, max: 100, noNaN: true });
const tangent = fc.oneof(
  fc.constantFrom<Tangent[]>('flat', 'linear', 'smooth'),
  fc.double({ min: -20, max: 20, noNaN: true }),
);
const extrapolation = fc.constantFrom(...EXTRAPOLATIONS);
const keys = (minLength: number) =>
  fc
    .uniqueArray(fc.integer({ min: -400, max: 400 }), { minLength, maxLength: 12 })
    .chain((ticks) =>
      fc.tuple(...ticks.sort((a, b) => a - b).map((tick) => fc.tuple(fc.constant(tick / 8), value, tangent, tangent))),
    );

describe('a channel', () => {
  it('a channel passes through its keys', () => {
    fc.assert(
      fc.property(keys(1), extrapolation, extrapolation, (ks, before, after) => {
        const evaluate = curve(channel(ks, before, after));
        // Plus 0: −0 is 0 here.
        for (const [t, v] of ks) expect(evaluate(t) + 0).toBe(v + 0);
      }),
    );
  });

  it('a channel is continuous at its keys', () => {
    fc.assert(
      fc.property(keys(2), (ks) => {
        const evaluate = curve(channel(ks));
        for (const [t, v] of ks) expectClose([evaluate(t - 1e-9), evaluate(t + 1e-9)], [v, v], 1e-4);
      }),
    );
  });

  it('a channel has its tangents as slopes on both sides of a key', () => {
    fc.assert(
      fc.property(keys(3), (ks) => {
        const c = channel(ks);
        const evaluate = curve(c);
        const slopes = resolvedSlopes(c);
        const h = 2 ** -26;
        for (let k = 1; k < ks.length - 1; k++) {
          const [t, v] = ks[k];
          expectClose([(v - evaluate(t - h)) / h, (evaluate(t + h) - v) / h], [slopes.in[k], slopes.out[k]], 0.02);
        }
      }),
    );
  });

  it('repeats with cycle, and climbs by the same each time with cycle_offset', () => {
    fc.assert(
      fc.property(
        keys(2),
        fc.integer({ min: -30, max: 30 }),
        fc.double({ min: 0.01, max: 0.99, noNaN: true }),
        (ks, n, u) => {
          const [start, stop] = [ks[0][0], ks[ks.length - 1][0]];
          const inside = start + u * (stop - start);
          const later = inside + n * (stop - start);
          const rise = ks[ks.length - 1][1] - ks[0][1];
          const within = 1e-7;
          const cycle = curve(channel(ks, 'cycle'));
          expectClose([cycle(later)], [cycle(inside)], within, 'cycle');
          const climbing = curve(channel(ks, 'cycle_offset'));
          expectClose([climbing(later)], [climbing(inside) + n * rise], within, 'cycle_offset');
        },
      ),
    );
  });

  it('a channel is its own mirror image about both ends with bounce', () => {
    fc.assert(
      fc.property(keys(2), fc.double({ min: 0, max: 200, noNaN: true }), (ks, far) => {
        const [start, stop] = [ks[0][0], ks[ks.length - 1][0]];
        const bounce = curve(channel(ks, 'bounce'));
        expectClose([bounce(stop + far), bounce(start - far)], [bounce(stop - far), bounce(start + far)], 1e-7);
      }),
    );
  });

  it('a channel is finite at any finite time, and comes back at any other', () => {
    fc.assert(
      fc.property(keys(1), extrapolation, extrapolation, fc.double(), (ks, before, after, t) => {
        expect(curve(channel(ks, before, after))(t)).toSatisfy(Number.isFinite);
      }),
    );
  });

  it('a channel is finite for keys of any size', () => {
    const key = fc.tuple(
      fc.double({ noNaN: true, noDefaultInfinity: true }),
      fc.double({ noNaN: true, noDefaultInfinity: true }),
    );
    fc.assert(
      fc.property(fc.array(key, { minLength: 1, maxLength: 5 }), extrapolation, time, (ks, e, t) => {
        const sorted = ks.sort((a, b) => a[0] - b[0]).map(([kt, kv]): Key => [kt, kv, 'smooth', 'linear']);
        const evaluate = curve(channel(sorted, e));
        expect(Number.isNaN(evaluate(t))).toBe(false);
        for (const [kt] of sorted) expect(evaluate(kt)).toSatisfy(Number.isFinite);
      }),
    );
  });

  it('gives the end keys’ values at times that are no numbers', () => {
    for (const e of EXTRAPOLATIONS) {
      const evaluate = curve(
        channel(
          [
            [0, 1],
            [1, 5],
          ],
          e,
        ),
      );
      expect([evaluate(-Infinity), evaluate(Infinity), evaluate(Number.NaN)]).toEqual([1, 5, 1]);
    }
  });

  it('a channel is 0 without keys', () => {
    expect(at(channel([], 'linear'), 3)).toBe(0);
  });

  it('takes the later of two keys at one time from that time on', () => {
    const step = channel(
      [
        [0, 0],
        [1, 2],
        [1, 7],
        [2, 7],
      ].map(([t, v]): Key => [t, v, 'linear', 'linear']),
    );
    expect([at(step, 0.5), at(step, 1), at(step, 1.5)]).toEqual([1, 7, 7]);
    expect(at(step, 1 - 1e-12)).toBeCloseTo(2);
  });

  it('takes the later key at its very beginning and end too', () => {
    const first = channel([
      [0, 1, 'flat', 'flat'],
      [0, 2, 'flat', 'flat'],
      [1, 2, 'flat', 'flat'],
    ]);
    expect([at(first, -1e-9), at(first, 0)]).toEqual([1, 2]);
    const last = channel([
      [0, 1, 'flat', 'flat'],
      [1, 1, 'flat', 'flat'],
      [1, 4, 'flat', 'flat'],
    ]);
    expect([at(last, 1), at(last, 2)]).toEqual([4, 4]);
    expect(at(last, 1 - 1e-9)).toBeCloseTo(1);
  });

  it('begins a cycle anew on every boundary, whatever rounding does to it', () => {
    const cycle = curve(
      channel(
        [
          [0.1, 3, 'linear', 'linear'],
          [1.2, 5, 'linear', 'linear'],
        ],
        'cycle',
      ),
    );
    for (let n = -1000; n <= 1000; n++) if (n !== 1) expect(cycle(0.1 + n * 1.1)).toBeCloseTo(3, 9);
    expect(cycle(1.2)).toBe(5);
  });

  it('a channel stays exact far from its keys', () => {
    const c = channel(
      [
        [0, 0, 'linear', 'linear'],
        [1, 1, 'linear', 'linear'],
      ],
      'cycle',
    );
    expect(at(c, 1e6 + 0.25)).toBe(0.25);
    expect(at(c, -1e6 + 0.25)).toBe(0.25);
    expect(at({ ...c, extrapolateOut: 'cycle_offset' }, 1e6 + 0.25)).toBe(1e6 + 0.25);
    expect(at({ ...c, extrapolateOut: 'bounce' }, 1e6 + 0.25)).toBe(0.25);
    expect(at({ ...c, extrapolateOut: 'bounce' }, 1e6 + 1.25)).toBe(0.75);
  });
});

describe('slopes of keys', () => {
  it('slopes of keys follow the neighbours', () => {
    const kinds = (kind: Tangent): KeyedChannel =>
      channel(
        [
          [0, 0],
          [1, 2],
          [3, 3],
          [4, 3],
        ].map(([t, v]): Key => [t, v, kind, kind]),
      );
    expect(resolvedSlopes(kinds('linear'))).toEqual({
      in: Float64Array.of(2, 2, 0.5, 0),
      out: Float64Array.of(2, 0.5, 0, 0),
    });
    const smooth = Float64Array.of(2, 1, 1 / 3, 0);
    expect(resolvedSlopes(kinds('smooth'))).toEqual({ in: smooth, out: smooth });
    expect(resolvedSlopes(kinds('flat')).in).toEqual(new Float64Array(4));
    expect(resolvedSlopes(kinds(-1.5)).out).toEqual(new Float64Array(4).fill(-1.5));
  });

  it('slopes of keys are 0 for a lone key and along a segment of no length, unless given', () => {
    expect(resolvedSlopes(channel([[0, 3, 'smooth', 'linear']]))).toEqual({
      in: Float64Array.of(0),
      out: Float64Array.of(0),
    });
    const step = resolvedSlopes(
      channel([
        [0, 0, 'linear', 'linear'],
        [0, 9, 'linear', 2],
        [1, 9, 'linear', 'linear'],
      ]),
    );
    expect(step).toEqual({ in: Float64Array.of(0, 0, 0), out: Float64Array.of(0, 2, 0) });
  });
});

describe('a compiled take', () => {
  const take = {
    name: 'c',
    range: [0, 1] as const,
    channels: [channel([[0, 1]]), restChannel(), channel([[0, 3]])],
  };

  provideReuse(RECOMPILED);

  it('a compiled take is made once', () => {
    expect(compileTake(take)).toBe(compileTake(take));
    expect(compileTake({ ...take })).not.toBe(compileTake(take));
  });

  it('a compiled take is the same after an edit of one channel as if all of it were compiled anew', () => {
    const any = fc.record({ ks: keys(0), before: extrapolation, after: extrapolation });
    fc.assert(
      fc.property(fc.array(any, { minLength: 1, maxLength: 5 }), any, fc.nat(), (list, other, at) => {
        const made = (c: typeof other) => (c.ks.length ? channel(c.ks, c.before, c.after) : restChannel());
        const before = { ...take, channels: list.map(made) };
        const kept = compileTake(before);
        const channels = before.channels.with(at % list.length, made(other));
        const fresh = structuredClone(channels);
        expectEqual(compileTake({ ...take, channels }), compileChannels(fresh));
        expect(kept.channelCount).toBe(list.length);
      }),
    );
  });

  it('a compiled take is the same after an edit anywhere in a long channel as if it were compiled anew', () => {
    const kinds = ['flat', 'linear', 'smooth', 3] as const;
    const long = Array.from({ length: 700 }, (_, i): Key => [i, (i * 7919) % 13, kinds[i % 4], kinds[(i >> 2) % 4]]);
    const edit = fc.record({ at: fc.nat(699), removed: fc.nat(2), added: fc.nat(2), value: fc.integer() });
    fc.assert(
      fc.property(fc.array(edit, { minLength: 1, maxLength: 3 }), (edits) => {
        let keyList = long;
        let held = compileTake({ ...take, channels: [channel(long)] });
        // Plus 0: a value of -0 is the same value, and may well be kept as 0.
        for (const { at, removed, added, value: to } of edits) {
          const put = Array.from({ length: added }, (_, i): Key => [at + i / 4, (to % 17) + 0, 'smooth', 'linear']);
          keyList = keyList.toSpliced(at, removed, ...put);
          keyList = keyList.map((key, i): Key => (i === at ? [key[0], (to % 5) + 0, 'smooth', 'flat'] : key));
          const edited = channel(keyList, 'linear');
          held = compileTake({ ...take, channels: [edited] });
          expectEqual(held, compileChannels([structuredClone(edited)]));
        }
      }),
      { numRuns: 60 },
    );
  });

  it('a compiled take has the rest value of a channel without keys, at any time', () => {
    const resting = { ...take, channels: [restChannel(), restChannel(2.5), channel([[1, 7]])] };
    const out = new Float64Array(3);
    for (const time of [-1e6, -1, 0, 0.5, 1e6]) {
      evaluateTake(compileTake(resting), time, out);
      expect([...out]).toEqual([0, 2.5, 7]);
      expect(evaluateChannel(compileTake(resting), 1, time)).toBe(2.5);
    }
  });

  it('fills as many channels as asked', () => {
    const out = new Float64Array(4).fill(-1);
    evaluateTake(compileTake(take), 0, out);
    expect(out).toEqual(Float64Array.of(1, 0, 3, -1));
    out.fill(-1);
    evaluateTake(compileTake(take), 0, out, 1);
    expect(out).toEqual(Float64Array.of(1, -1, -1, -1));
  });

  it('gives all channels at once as it gives each', () => {
    const any = fc.record({ ks: keys(0), before: extrapolation, after: extrapolation });
    fc.assert(
      fc.property(fc.array(any, { maxLength: 5 }), fc.integer({ min: -1000, max: 1000 }), (list, tick) => {
        const c = compileChannels(
          list.map(({ ks, before, after }) => (ks.length ? channel(ks, before, after) : restChannel())),
        );
        const out = new Float64Array(list.length);
        evaluateTake(c, tick / 8, out);
        expect([...out]).toEqual(list.map((_, i) => evaluateChannel(c, i, tick / 8)));
      }),
    );
  });

  it('agrees with the Hermite basis', () => {
    fc.assert(
      fc.property(
        value,
        value,
        value,
        value,
        fc.double({ min: 0.01, max: 10, noNaN: true }),
        fc.double({ min: 0, max: 1, noNaN: true }),
        (v0, v1, m0, m1, h, u) => {
          const expected =
            (2 * u ** 3 - 3 * u ** 2 + 1) * v0 +
            (u ** 3 - 2 * u ** 2 + u) * h * m0 +
            (-2 * u ** 3 + 3 * u ** 2) * v1 +
            (u ** 3 - u ** 2) * h * m1;
          expectClose(
            [
              at(
                channel([
                  [0, v0, 0, m0],
                  [h, v1, m1, 0],
                ]),
                u * h,
              ),
            ],
            [expected],
            1e-9,
            'value',
          );
        },
      ),
    );
  });
});
