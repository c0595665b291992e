import { describe, expect, it } from 'vitest';
import { playsFrames, sharedFrameRate } from '../../src/edit/frame-rate.ts';
import type { Character } from '../../src/model/document.ts';
import type { Take } from '../../src/model/takes/take.ts';
import { character, documentOf, takeOfValues } from '../helpers/builders.ts';

function sampled(id: string, frameSeconds: number, more: Partial<Character> = {}): Character {
  const frames: Take = {
    ...takeOfValues(id, [], [0, 10 * frameSeconds]),
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
  return character({ id, name: id, takes: [frames], shownTake: 0, ...more });
}

describe('what plays', () => {
  const keyed = character({ id: 'k', takes: [takeOfValues('keys', [0, 1])], shownTake: 0 });

  it('what plays has one rate if everything visible has the same', () => {
    expect(sharedFrameRate(documentOf(sampled('a', 0.0083333), sampled('b', 1 / 120)))).toBe(120);
    expect(sharedFrameRate(documentOf(sampled('a', 0.01), sampled('b', 0.02)))).toBeUndefined();
    expect(sharedFrameRate(documentOf(sampled('a', 0.01), sampled('b', 0.02, { isHidden: true })))).toBe(100);
    expect(sharedFrameRate(documentOf(sampled('a', 0.01), keyed))).toBeUndefined();
    expect(sharedFrameRate(documentOf())).toBeUndefined();
  });

  it('what plays has frames if a take has a rate, stated or of its own', () => {
    expect(playsFrames(documentOf(keyed))).toBe(false);
    expect(playsFrames(documentOf(keyed, sampled('a', 0.01)))).toBe(true);
    const stated = { ...keyed, takes: [{ ...takeOfValues('stated', [0, 1]), framesPerSecond: 25 }] };
    expect(playsFrames(documentOf(stated))).toBe(true);
    expect(sharedFrameRate(documentOf(stated, sampled('a', 0.04)))).toBe(25);
  });
});
