import { describe, expect, it } from 'vitest';
import { dropPlace, rowPart, whyNoDrop } from '../../../../src/ui/editors/outliner/drop-place.ts';
import { skeleton } from '../../builders.ts';

//   0 root
//   1   spine
//   2     head
//   3   leg_l
//   4     foot_l
//   5   leg_r
const { joints } = skeleton(['root', -1], ['spine', 0], ['head', 1], ['leg_l', 0], ['foot_l', 3], ['leg_r', 0]);

describe('why a joint stays where it is dropped', () => {
  const named = joints.map((one, j) => ({ ...one, name: j === 4 ? '' : `j${j}` }));

  it('dropping a joint on its own descendant is refused with a reason', () => {
    expect(whyNoDrop(named, 3, 4)).toBe('j3 can’t be parented to its descendant joint 4.');
    expect(whyNoDrop(named, 1, 2)).toBe('j1 can’t be parented to its descendant j2.');
  });

  it('dropping a joint on itself or elsewhere needs no reason', () => {
    expect([whyNoDrop(named, 3, 3), whyNoDrop(named, 1, 3), whyNoDrop(named, 3, 1)]).toEqual([
      undefined,
      undefined,
      undefined,
    ]);
  });
});

describe('a joint dropped on a row', () => {
  it('a row has an upper, a middle and a lower part', () => {
    expect([0.1, 0.5, 0.9].map(rowPart)).toEqual(['above', 'on', 'below']);
  });

  it('a joint dropped on a row becomes its last child', () => {
    expect(dropPlace(joints, 5, 1, 'on', true)).toEqual({ parent: 1 });
  });

  it('a joint dropped beside a row is inserted before or after it', () => {
    expect(dropPlace(joints, 5, 3, 'above', true)).toEqual({ parent: 0, before: 3 });
    expect(dropPlace(joints, 5, 1, 'below', false)).toEqual({ parent: 0, before: 3 });
    expect(dropPlace(joints, 1, 5, 'below', false)).toEqual({ parent: 0 });
  });

  it('a joint dropped below an expanded row becomes its first child', () => {
    expect(dropPlace(joints, 5, 3, 'below', true)).toEqual({ parent: 3, before: 4 });
  });

  it('a joint is not moved to where it already is, or into its own hierarchy', () => {
    expect(dropPlace(joints, 2, 1, 'on', true)).toBeUndefined();
    expect(dropPlace(joints, 3, 5, 'above', false)).toBeUndefined();
    expect(dropPlace(joints, 3, 1, 'below', false)).toBeUndefined();
    expect(dropPlace(joints, 3, 4, 'on', false)).toBeUndefined();
    expect(dropPlace(joints, 0, 3, 'on', true)).toBeUndefined();
  });

  it('a joint dropped beside the root becomes its child', () => {
    expect(dropPlace(joints, 2, 0, 'above', true)).toEqual({ parent: 0 });
    expect(dropPlace(joints, 2, 0, 'below', true)).toEqual({ parent: 0, before: 1 });
  });
});
