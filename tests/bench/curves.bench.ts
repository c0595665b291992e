/**
 * A pose of 10,000 channels at random times, against a bare loop over the same typed arrays: a binary search and one
 * cubic per channel, without extrapolation. Goal: at most twice its time.
 */
import { bench, describe } from 'vitest';
import { compileTake } from '../../src/evaluate/compiled-take.ts';
import { evaluateTake } from '../../src/evaluate/curves.ts';
import type { Take } from '../../src/model/takes/take.ts';
import { SMOOTH } from '../../src/model/takes/tangent-kinds.ts';

const CHANNELS = 10_000;
const SECONDS = 10;

/** Pseudorandom numbers, the same in every run. */
function* noise(seed: number): Generator<number, never> {
  let state = seed;
  while (true) {
    state = (Math.imul(state, 1664525) + 1013904223) | 0;
    yield (state >>> 0) / 2 ** 32;
  }
}

/** Random, since synchronised channels would let the processor predict every branch of the search. */
function keyTimes(keys: number, random: Generator<number, never>): Float64Array {
  const times = Float64Array.from({ length: keys }, () => SECONDS * random.next().value).sort();
  times[0] = 0;
  times[keys - 1] = SECONDS;
  return times;
}

function randomTake(keys: number): Take {
  const random = noise(keys);
  const tangents = { kinds: new Uint8Array(keys).fill(SMOOTH), slopes: new Float64Array(keys) };
  return {
    name: 'random',
    range: [0, SECONDS],
    channels: Array.from({ length: CHANNELS }, () => ({
      kind: 'keys',
      extrapolateIn: 'cycle',
      extrapolateOut: 'cycle',
      times: keyTimes(keys, random),
      values: Float64Array.from({ length: keys }, () => random.next().value),
      tangentsIn: tangents,
      tangentsOut: tangents,
    })),
  };
}

for (const keys of [4, 30, 300]) {
  describe(`10,000 channels of ${keys} keys, all at a random time`, () => {
    const take = compileTake(randomTake(keys));
    const { firstKey, times, cubics } = take;
    const out = new Float64Array(CHANNELS);
    const random = noise(7);

    bench('ours', () => {
      evaluateTake(take, SECONDS * random.next().value, out);
    });

    bench('bare loop', () => {
      const t = SECONDS * random.next().value;
      for (let c = 0; c < CHANNELS; c++) {
        let low = firstKey[c];
        let high = firstKey[c + 1] - 1;
        while (high - low > 1) {
          const middle = (low + high) >>> 1;
          if (times[middle] <= t) low = middle;
          else high = middle;
        }
        const d = t - times[low];
        const o = 4 * low;
        out[c] = ((cubics[o + 3] * d + cubics[o + 2]) * d + cubics[o + 1]) * d + cubics[o];
      }
    });
  });
}
