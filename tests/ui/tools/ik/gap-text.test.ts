import { describe, expect, it } from 'vitest';
import { gapText } from '../../../../src/ui/tools/ik/gap-text.ts';
import { character, skeleton } from '../../builders.ts';

const ch = character({ skeleton: skeleton(['root', -1], ['hip_l', 0], ['knee_l', 1], ['hip_r', 0]) });
/** Of the joints, x. */
const [ROOT, HIP_L, KNEE_L, HIP_R] = [3, 6, 9, 12];

describe('what is in the way of a pin', () => {
  it('is the limit that binds', () => {
    expect(gapText(ch, 2, [KNEE_L])).toBe('knee_l rx at its limit');
  });
  it('is named from the pin to the root, others after that, and counted where there are many', () => {
    expect(gapText(ch, 2, [ROOT, HIP_L, KNEE_L])).toBe('knee_l rx, hip_l rx, root rx at their limits');
    expect(gapText(ch, 2, [HIP_R, HIP_L])).toBe('hip_l rx, hip_r rx at their limits');
    expect(gapText(ch, 2, [HIP_R, ROOT, HIP_L, KNEE_L, KNEE_L + 1])).toBe(
      'knee_l rx, knee_l ry, hip_l rx and 2 more at their limits',
    );
  });
  it('is the distance where no limit binds, and the locks where nothing can move', () => {
    expect(gapText(ch, 2, [])).toBe('out of reach');
    expect(gapText(ch, 2, [], false)).toBe('nothing here is free to move');
  });
});
