import { describe, expect, it } from 'vitest';
import { frameRateOf, playsSamples, sharedFrameRate } from '../../src/edit/frame-rate.ts';
import type { ChannelClip } from '../../src/model/clip.ts';
import type { Character } from '../../src/model/document.ts';
import { character, clip, documentOf } from '../helpers/builders.ts';

const rateOf = (frameSeconds: number, frameCount = 100) => frameRateOf({ frameSeconds, frameCount });

function sampled(id: string, frameSeconds: number, more: Partial<Character> = {}): Character {
  const frames: ChannelClip = {
    ...clip(id, [], [0, 10 * frameSeconds]),
    samples: {
      frameCount: 11,
      frameSeconds,
      startSeconds: 0,
      firstChannel: 0,
      values: new Float64Array(11),
      scales: Float64Array.of(1),
      interpolation: 'linear',
    },
  };
  return character({ id, name: id, clips: [frames], shownClip: 0, ...more });
}

describe('the frame rate', () => {
  it.each([
    [0.0333333, 30],
    [0.033333, 30],
    [0.0333, 30],
    [0.008333, 120],
    [0.0083333, 120],
    [1 / 120, 120],
    [Math.fround(1 / 60), 60],
    [0.01666667, 60],
    [0.01, 100],
    [0.008, 125],
    [0.04, 25],
    [0.041667, 24],
  ])('of a frame time of %d is the whole one that it stands for: %d', (frameSeconds, rate) => {
    expect(rateOf(frameSeconds)).toBe(rate);
  });

  it('the frame rate of television is not a whole number', () => {
    expect(rateOf(0.033367)).toBeCloseTo(30 / 1.001, 10);
    expect(rateOf(0.0166834)).toBeCloseTo(60 / 1.001, 10);
  });

  it('the frame rate is as in the file if it is no usual one', () => {
    expect(rateOf(0.03)).toBe(1 / 0.03);
  });

  it('counts every frame of a long take like the file, whatever the rounding', () => {
    for (const frameSeconds of [0.0333, 0.033333, 0.008333, 0.0083333, 0.0167]) {
      const frameCount = 40_000;
      const last = (frameCount - 1) * frameSeconds * rateOf(frameSeconds, frameCount);
      expect(Math.round(last), String(frameSeconds)).toBe(frameCount - 1);
    }
  });
});

describe('what plays', () => {
  const keyed = character({ id: 'k', clips: [clip('keys', [0, 1])], shownClip: 0 });

  it('what plays has one rate if everything visible has the same', () => {
    expect(sharedFrameRate(documentOf(sampled('a', 0.0083333), sampled('b', 1 / 120)))).toBe(120);
    expect(sharedFrameRate(documentOf(sampled('a', 0.01), sampled('b', 0.02)))).toBeUndefined();
    expect(sharedFrameRate(documentOf(sampled('a', 0.01), sampled('b', 0.02, { isHidden: true })))).toBe(100);
    expect(sharedFrameRate(documentOf(sampled('a', 0.01), keyed))).toBeUndefined();
    expect(sharedFrameRate(documentOf())).toBeUndefined();
  });

  it('what plays is frames, or keys alone', () => {
    expect(playsSamples(documentOf(keyed))).toBe(false);
    expect(playsSamples(documentOf(keyed, sampled('a', 0.01)))).toBe(true);
  });
});
