import { describe, expect, it } from 'vitest';
import { idleText } from '../../../../src/ui/editors/skin/weights-dialog.ts';
import { skeleton } from '../../builders.ts';

const rig = skeleton(['hips', -1], ['spine', 0], ['head', 1], ['jaw', 2], ['ear_l', 2], ['', 2]);

describe('what is said of joints that move nothing', () => {
  it('names the first few and counts all', () => {
    expect(idleText(rig, [1, 2, 3, 4, 5])).toBe(
      '5 of 6 joints move nothing: their bones are outside the skin, or others are closer (spine, head, jaw, ear_l, …).',
    );
    expect(idleText(rig, [5])).toBe(
      '1 of 6 joints moves nothing: its bone is outside the skin, or others are closer (joint 5).',
    );
  });

  it('what is said of joints that move nothing is empty if all move something', () =>
    expect(idleText(rig, [])).toBe(''));
});
