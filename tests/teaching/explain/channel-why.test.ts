import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileTake } from '../../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../src/evaluate/curves.ts';
import { shownTake } from '../../../src/model/document.ts';
import { type Extrapolation, type KeyedChannel, restChannel, type Take } from '../../../src/model/takes/take.ts';
import { FIXED_TANGENT, FLAT, LINEAR, SMOOTH } from '../../../src/model/takes/tangent-kinds.ts';
import { valueOfChain, whySegment, whyValue } from '../../../src/teaching/explain/channel-why.ts';
import { tangentText, whyTangent } from '../../../src/teaching/explain/tangent-why.ts';
import { take as anyTake } from '../../formats/arbitraries.ts';
import { describeShared } from '../../helpers/shared.ts';
import { channel as keysAt, take } from '../../ui/builders.ts';
import { characterOf, OWN, SHARED } from '../lesson-files.ts';

describe('why our examples have their values', () => {
  it.each(Object.entries(OWN))('ends at the very value that evaluation gives: %s', (_, files) => {
    expectSame(shownTake(characterOf(...files)));
  });
});

describeShared('why the reference files have their values', () => {
  const moving = Object.entries(SHARED).filter(([, files]) => files.some((file) => /\.(anim|bvh)$/.test(file)));
  it.each(moving)('ends at the very value that evaluation gives: %s', (_, files) => {
    expectSame(shownTake(characterOf(...files)));
  });
});

describe('why a random channel has its value', () => {
  it('a random channel’s chain ends at the very value that evaluation gives', () => {
    const time = fc.oneof(fc.double({ min: -20, max: 20, noNaN: true }), fc.double());
    fc.assert(
      fc.property(anyTake, fc.array(time, { minLength: 3, maxLength: 3 }), (of, times) => {
        const own = of.channels.flatMap((each) => (each.kind === 'keys' ? [...each.times] : []));
        expectAt(of, [...times, ...own]);
      }),
      { numRuns: 500 },
    );
  });
});

describe('why a channel has its value', () => {
  const wave = channel([0, 0.5, 0.75, 2], [1, -0.3, 0.25, 4], LINEAR);

  it('says of each tangent where its slope comes from, in numbers', () => {
    const smooth = channel([0, 0.5, 0.75, 2], [1, -0.3, 0.25, 4], SMOOTH);
    expect(text(wave, 2, 'in')).toBe('linear in: (0.25 − (-0.3)) / (0.75 − 0.5) = 2.2');
    expect(text(wave, 2, 'out')).toBe('linear out: (4 − 0.25) / (2 − 0.75) = 3');
    expect(text(smooth, 2, 'in')).toBe('smooth in: (4 − (-0.3)) / (2 − 0.5) = 2.867');
    expect(text(smooth, 0, 'in')).toBe('smooth in, of the first segment: (-0.3 − 1) / (0.5 − 0) = -2.6');
    expect(text(smooth, 3, 'out')).toBe('smooth out, of the last segment: (4 − 0.25) / (2 − 0.75) = 3');
    expect(text(channel([0, 1], [0, 1], FLAT), 0, 'out')).toBe('flat out: 0');
    expect(text(channel([0, 1], [0, 1], FIXED_TANGENT, 7), 0, 'out')).toBe('fixed out: 7, as written');
    expect(text(channel([0], [3], SMOOTH), 0, 'in')).toBe('smooth in: a lone key has slope 0');
    expect(text(channel([0, 1, 1], [0, 1, 5], LINEAR), 2, 'in')).toBe('linear in: two keys at one time: slope 0');
  });

  it('has the four inputs and the coefficients of the textbook, whose cubic is the one that is evaluated', () => {
    const why = whyValue(take([0, 2], channel([0, 2], [1, 3], FIXED_TANGENT, 0.5)), 0, 0.5);
    if (why?.kind !== 'keys' || !why.segment) throw new Error('No segment.');
    const { inputs, inU, u, value, h, tau } = why.segment;
    expect({ inputs, inU, u, h, tau }).toEqual({ inputs: [1, 3, 1, 1], inU: [-2, 3, 1, 1], u: 0.25, h: 2, tau: 0.5 });
    const [a, b, c, d] = inU;
    expect(((a * u + b) * u + c) * u + d).toBeCloseTo(value, 14);
  });

  it('folds a time outside the keys, and says what is added', () => {
    const at = (out: Extrapolation, time: number) => {
      const why = whyValue(
        take([0, 2], { ...channel([1, 3], [0, 5], FLAT), extrapolateIn: out, extrapolateOut: out }),
        0,
        time,
      );
      return why?.kind === 'keys' ? why.outside : undefined;
    };
    expect(at('cycle_offset', 6)).toEqual({
      kind: 'cycle_offset',
      side: 'after',
      period: 2,
      length: 2,
      since: 1,
      isMirrored: false,
      folded: 2,
      change: 5,
      added: 10,
    });
    expect(at('cycle_offset', 0.5)).toMatchObject({ side: 'before', period: -1, since: 1.5, folded: 2.5, added: -5 });
    expect(at('bounce', 3.5)).toMatchObject({ period: 1, isMirrored: true, folded: 2.5, added: 0 });
    expect(at('linear', 4)).toMatchObject({ key: 1, seconds: 1, tangent: { slope: 0, kind: 'flat' } });
    expect(at('constant', 4)).toEqual({ kind: 'constant', side: 'after', key: 1 });
    expect(at('cycle', 2)).toBeUndefined();
  });

  it('of a lone key that repeats is the key itself', () => {
    const lone = { ...channel([1], [5], FLAT), extrapolateOut: 'cycle' as const };
    expect(whyValue(take([0, 2], lone), 0, 9)).toMatchObject({
      outside: { kind: 'constant', key: 0 },
      at: 0,
      value: 5,
    });
  });

  it('of a resting channel is its value, and there is none of a channel that is not there', () => {
    expect(whyValue(take([0, 2], restChannel(0.5)), 0, 1)).toEqual({ kind: 'rest', value: 0.5 });
    expect(whyValue(take([0, 2]), 0, 1)).toBeUndefined();
    expect(whySegment(take([0, 2], wave), 0, 3)).toBeUndefined();
  });
});

function channel(times: number[], values: number[], kind: number, slope = 0): KeyedChannel {
  const made = keysAt(...times);
  for (const { kinds, slopes } of [made.tangentsIn, made.tangentsOut]) {
    kinds.fill(kind);
    slopes.fill(slope);
  }
  made.values.set(values);
  return made;
}

function text(keys: KeyedChannel, key: number, side: 'in' | 'out'): string {
  return tangentText(keys, whyTangent(keys, key, side), (value) => String(Number(value.toFixed(3))));
}

function expectSame(of: Take | undefined): void {
  if (!of) return;
  const [from, to] = of.range;
  const times = [from, to, from - 0.73, to + 3.1];
  for (let i = 0; i < 11; i++) times.push(from + ((to - from) * (i + 0.37)) / 11);
  expectAt(of, times);
}

function expectAt(of: Take, times: readonly number[]): void {
  const compiled = compileTake(of);
  of.channels.forEach((each, c) => {
    for (const time of times) {
      const why = whyValue(of, c, time);
      const meant = evaluateChannel(compiled, c, time);
      if (!why || !Object.is(why.value, meant)) expect(why?.value, `channel ${c} at ${time}`).toBe(meant);
      if (why?.kind !== 'keys' || each.kind !== 'keys') continue;
      const chain = valueOfChain(each, why);
      // What overflows is the end key's value instead.
      if (chain !== meant && Number.isFinite(chain)) expect(chain, `channel ${c} at ${time}`).toBe(meant);
      if (why.segment && !why.segment.isDegenerate) {
        expect(why.segment.tangents.map(({ slope }) => slope).every(Number.isFinite)).toBe(true);
      }
    }
  });
}
