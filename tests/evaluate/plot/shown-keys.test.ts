import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { bucketKeys, MEANT_KEY, NO_KEY, OTHER_KEY } from '../../../src/evaluate/plot/key-buckets.ts';
import {
  nextKey,
  previousKey,
  type ShownChannel,
  shownKeys,
  takesRange,
} from '../../../src/evaluate/plot/shown-keys.ts';
import { channel, character, documentOf, skeleton, take } from '../../ui/builders.ts';

const two = skeleton(['hips', -1], ['leg', 0]);

function shown(times: readonly number[], meant = true, offsetSeconds = 0): ShownChannel {
  return { times: Float64Array.from(times), meant, offsetSeconds };
}

describe('shownKeys', () => {
  // Three translations, then three rotations a joint.
  const channels = Array.from({ length: 9 }, (_, i) => channel(i));
  const wasp = character({ skeleton: two, takes: [take([0, 1], ...channels)] });
  const meantTimes = (joint: number) =>
    shownKeys(documentOf(wasp), { characterId: 'c1', joint }).flatMap((c) => (c.meant ? [...c.times] : []));

  it('means all keys where no joint is selected', () => {
    expect(shownKeys(documentOf(wasp), {}).every((c) => c.meant)).toBe(true);
  });

  it('means the selected joint’s, the root’s with its translation', () => {
    expect(meantTimes(1)).toEqual([6, 7, 8]);
    expect(meantTimes(0)).toEqual([0, 1, 2, 3, 4, 5]);
  });

  it('means all where the joint has none', () => {
    const bare = character({ skeleton: two, takes: [take([0, 1], channel(0, 1))] });
    const keys = shownKeys(documentOf(bare), { characterId: 'c1', joint: 1 });
    expect(keys.map((c) => c.meant)).toEqual([true]);
  });

  it('shownKeys shows the selected character’s only', () => {
    const other = character({ id: 'c2', takes: [take([0, 1], channel(9))] });
    expect(shownKeys(documentOf(wasp, other), { characterId: 'c2' })).toHaveLength(1);
    expect(shownKeys(documentOf(wasp, other), {})).toHaveLength(10);
  });
});

describe('nextKey and previousKey', () => {
  const keys = [shown([0, 1, 2]), shown([0.5, 1.5], true, 0.25), shown([0.1], false)];

  it('take the nearest of all channels, on the transport’s time', () => {
    expect(nextKey(keys, 0)).toBe(0.25);
    expect(nextKey(keys, 0.25)).toBe(1);
    expect(previousKey(keys, 2)).toBe(1.25);
    expect(nextKey(keys, 2)).toBeUndefined();
    expect(previousKey(keys, 0)).toBeUndefined();
  });

  it('walk over every key once, there and back', () => {
    const times = fc.array(fc.integer({ min: -50, max: 50 }), { minLength: 1, maxLength: 30 });
    fc.assert(
      fc.property(times, (drawn) => {
        const sorted = [...new Set(drawn)].sort((a, b) => a - b);
        const channels = [shown(sorted)];
        const there: number[] = [];
        for (let t = nextKey(channels, -100); t !== undefined; t = nextKey(channels, t)) there.push(t);
        const back: number[] = [];
        for (let t = previousKey(channels, 100); t !== undefined; t = previousKey(channels, t)) back.push(t);
        expect(there).toEqual(sorted);
        expect(back.reverse()).toEqual(sorted);
      }),
    );
  });
});

describe('bucketKeys', () => {
  const buckets = (channels: readonly ShownChannel[], from: number, perPixel: number, pixels: number) => {
    const out = new Uint8Array(pixels).fill(9);
    bucketKeys(channels, from, perPixel, out);
    return [...out];
  };

  it('marks the pixel that a key falls into', () => {
    expect(buckets([shown([-1, 0, 0.25, 0.35, 2])], 0, 0.1, 4)).toEqual([MEANT_KEY, NO_KEY, MEANT_KEY, MEANT_KEY]);
  });

  it('lets keys that are meant win over others', () => {
    expect(buckets([shown([0, 1]), shown([0, 2], false)], 0, 1, 3)).toEqual([MEANT_KEY, MEANT_KEY, OTHER_KEY]);
  });

  it('jumps through dense channels to the same marks as one by one', () => {
    const step = fc.double({ min: 0, max: 0.02, noNaN: true });
    fc.assert(
      fc.property(
        fc.array(step, { minLength: 200, maxLength: 600 }),
        fc.integer({ min: 1, max: 12 }),
        (steps, pixels) => {
          let time = -0.5;
          const times = steps.map((s) => {
            time += s;
            return time;
          });
          const expected = new Array<number>(pixels).fill(NO_KEY);
          for (const t of times) {
            const pixel = Math.floor(t / (1 / pixels));
            if (t >= 0 && t < 1) expected[Math.min(pixels - 1, pixel)] = MEANT_KEY;
          }
          expect(buckets([shown(times)], 0, 1 / pixels, pixels)).toEqual(expected);
        },
      ),
    );
  });

  it('ends where many keys are at one time', () => {
    expect(buckets([shown(new Array<number>(1000).fill(0.5))], 0, 0.5, 2)).toEqual([NO_KEY, MEANT_KEY]);
  });
});

it('spans the takes of all characters, with their offsets', () => {
  const a = character({ takes: [take([0, 2])] });
  const b = character({ id: 'c2', takes: [take([1, 3])], timeOffsetSeconds: 2 });
  expect(takesRange(documentOf(a, b))).toEqual([-1, 2]);
  expect(takesRange(documentOf(character()))).toBeUndefined();
});
