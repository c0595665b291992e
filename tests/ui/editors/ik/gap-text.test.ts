import { describe, expect, it } from 'vitest';
import { gapCause, type Hindrance } from '../../../../src/evaluate/ik/drag/hindrance.ts';
import { gapText } from '../../../../src/ui/editors/ik/gap-text.ts';
import { character, skeleton } from '../../builders.ts';

const ch = character({
  skeleton: skeleton(['root', -1], ['hip_l', 0], ['knee_l', 1], ['hip_r', 0], ['knee_r', 3], ['', 0]),
});
/** x rotation of each joint. */
const [ROOT, HIP_L, KNEE_L, HIP_R] = [3, 6, 9, 12];
const NOTHING: Hindrance = { binding: [], holders: [], locks: [], canMove: true, rootStays: false };
const text = (change: Partial<Hindrance>) => gapText(ch, 2, { ...NOTHING, ...change });

describe('what is in the way of a pin', () => {
  it('a limit that binds is named', () => {
    expect(text({ binding: [KNEE_L] })).toBe('knee_l rx at its limit');
  });
  it('limits are named from the pin to the root, then others, and counted if there are many', () => {
    expect(text({ binding: [ROOT, HIP_L, KNEE_L] })).toBe('knee_l rx, hip_l rx, root rx at their limits');
    expect(text({ binding: [HIP_R, HIP_L] })).toBe('hip_l rx, hip_r rx at their limits');
    expect(text({ binding: [HIP_R, ROOT, HIP_L, KNEE_L, KNEE_L + 1] })).toBe(
      'knee_l rx, knee_l ry, hip_l rx and 2 more at their limits',
    );
  });
  it('the distance is named if no limit binds and nothing holds, and the locks if nothing can move', () => {
    expect(text({})).toBe('out of reach');
    expect(text({ canMove: false })).toBe('nothing here can move');
  });
  it('pins that hold are named, each joint once and never its own', () => {
    expect(text({ holders: [4] })).toBe('out of reach while knee_r holds');
    expect(text({ holders: [4, 5, 4, 2] })).toBe('out of reach while knee_r and joint 5 hold');
    expect(text({ holders: [4, 5, 1, 3] })).toBe('out of reach while knee_r, joint 5 and 2 more hold');
  });
  it('a lock is named beside a limit, before pins that hold, and if nothing can move because of it', () => {
    expect(text({ locks: [4], holders: [2, 4] })).toBe('knee_r is locked');
    expect(text({ locks: [4, 1], binding: [KNEE_L] })).toBe('knee_l rx at its limit, knee_r and hip_l are locked');
    expect(text({ locks: [1, 2, 3, 4] })).toBe('hip_l, knee_l and 2 more are locked');
    expect(text({ locks: [1], canMove: false })).toBe('hip_l is locked');
    // Follows its own name.
    expect(text({ locks: [2] })).toBe('it is locked');
  });
  it('the root is named if it could move and is not allowed to', () => {
    expect(text({ canMove: false, rootStays: true })).toBe('the root is fixed: allow it to move');
    expect(text({ rootStays: true })).toBe('out of reach while the root is fixed');
    expect(text({ rootStays: true, holders: [4] })).toBe('out of reach while knee_r holds');
  });
  it('one cause is named, the first that one would change', () => {
    const cause = (change: Partial<Hindrance>) => gapCause({ ...NOTHING, ...change });
    expect(cause({ canMove: false, rootStays: true, binding: [1], holders: [2] })).toBe('root');
    expect(cause({ canMove: false })).toBe('locks');
    expect(cause({ rootStays: true, binding: [1], holders: [2] })).toBe('limits');
    expect(cause({ rootStays: true, locks: [1], holders: [2] })).toBe('locks');
    expect(cause({ rootStays: true, holders: [2] })).toBe('pins');
    expect(cause({ rootStays: true })).toBe('root');
    expect(cause({})).toBe('reach');
  });
});
