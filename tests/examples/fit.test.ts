import { describe, expect, it } from 'vitest';
import { fitChannel } from '../../examples/characters/motion/fit.ts';
import { compileChannels } from '../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../src/evaluate/curves.ts';
import { keysOf } from '../../src/model/takes/take.ts';

const wave = (t: number) => Math.sin(2 * Math.PI * t) + 0.3 * Math.cos(6 * Math.PI * t);
const options = { from: 0, to: 1, frame: 0.02, tolerance: 0.004, extrapolation: 'cycle' } as const;

describe('fitting keys to a motion', () => {
  it('fitting keys to a motion keeps the curve within the tolerance, also a period later', () => {
    const compiled = compileChannels([fitChannel(wave, options)]);
    for (let t = 0.003; t < 2; t += 0.01) {
      expect(Math.abs(evaluateChannel(compiled, 0, t) - wave(t))).toBeLessThan(1.5 * options.tolerance);
    }
  });

  it('uses fewer keys for a larger tolerance', () => {
    const close = fitChannel(wave, options);
    const loose = fitChannel(wave, { ...options, tolerance: 0.05 });
    expect(keysOf(loose).times.length).toBeLessThan(keysOf(close).times.length);
  });

  it('writes one key for what does not move', () => {
    expect(fitChannel(() => 0.25, options)).toMatchObject({ times: Float64Array.of(0), values: Float64Array.of(0.25) });
  });

  it('gives a corner two slopes, and no other key', () => {
    const bouncing = (t: number) => Math.abs(Math.sin(2 * Math.PI * t));
    const { times, tangentsIn, tangentsOut } = keysOf(fitChannel(bouncing, { ...options, corners: [0.5] }));
    const corner = times.indexOf(0.5);
    expect(tangentsIn.slopes[corner]).toBeCloseTo(-2 * Math.PI, 1);
    expect(tangentsOut.slopes[corner]).toBeCloseTo(2 * Math.PI, 1);
    times.forEach((_, k) => {
      const isEnd = k === 0 || k === times.length - 1;
      if (k !== corner && !isEnd) expect(tangentsIn.slopes[k]).toBe(tangentsOut.slopes[k]);
    });
  });
});
