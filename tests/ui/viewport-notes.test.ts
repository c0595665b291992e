import { describe, expect, it } from 'vitest';
import { EMPTY_DOCUMENT } from '../../src/model/document.ts';
import { DEFAULT_DISPLAY } from '../../src/model/session.ts';
import { whatIsMissing } from '../../src/ui/viewport-pane.ts';
import { character, clip, skeleton } from './builders.ts';

describe('the note over the viewport', () => {
  it('asks for the skeleton of an animation that stands alone', () => {
    const alone = { ...EMPTY_DOCUMENT, characters: [character({ clips: [clip([0, 1])] })] };
    expect(whatIsMissing(alone, {}, DEFAULT_DISPLAY)).toBe('wasp has an animation only: drop its .skel');
    const whole = {
      ...EMPTY_DOCUMENT,
      characters: [character({ clips: [clip([0, 1])], skeleton: skeleton(['hips', -1]) })],
    };
    expect(whatIsMissing(whole, {}, DEFAULT_DISPLAY)).toBe('');
  });

  it('says nothing of an empty page', () => {
    expect(whatIsMissing(EMPTY_DOCUMENT, {}, { ...DEFAULT_DISPLAY, skin: 'heat' })).toBe('');
  });
});
