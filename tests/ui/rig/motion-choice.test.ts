import { describe, expect, it } from 'vitest';
import { dofsOf, type Motion } from '../../../src/model/skeleton.ts';
import { MOTION_LABELS, type MotionKind, motionOfKind, typedCompound } from '../../../src/ui/rig/motion-choice.ts';

const hinge: Motion = { kind: 'hinge', axis: [0, 0, 2] };
const bvh: Motion = { kind: 'bvh', channels: ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'], positions: 'replace' };

describe('another kind of joint', () => {
  it('keeps the axis, as it was written', () => {
    expect(motionOfKind('screw', hinge)).toEqual({ kind: 'screw', axis: [0, 0, 2], pitch: 1 });
    expect(motionOfKind('prismatic', { kind: 'ball', order: 'xyz' })).toEqual({ kind: 'prismatic', axis: [1, 0, 0] });
  });

  it('keeps the order, as far as it goes', () => {
    expect(motionOfKind('free', { kind: 'ball', order: 'zxy' })).toEqual({ kind: 'free', order: 'zxy' });
    expect(motionOfKind('universal', { kind: 'ball', order: 'zxy' })).toEqual({ kind: 'universal', order: 'zx' });
    expect(motionOfKind('ball', { kind: 'universal', order: 'yz' })).toEqual({ kind: 'ball', order: 'yzx' });
  });

  it('takes BVH’s order the other way round: it lists what is multiplied from left to right', () => {
    expect(motionOfKind('ball', bvh)).toEqual({ kind: 'ball', order: 'yxz' });
  });

  it('made of chosen DOFs has those of the one before', () => {
    expect(motionOfKind('compound', bvh)).toEqual({ kind: 'compound', dofs: bvh.channels });
    expect(motionOfKind('compound', { kind: 'quaternion' })).toEqual({ kind: 'compound', dofs: ['rx'] });
  });

  it('can be made of each kind', () => {
    for (const kind of Object.keys(MOTION_LABELS).filter((name) => name !== 'bvh')) {
      // All names of the table but one.
      const made = motionOfKind(kind as Exclude<MotionKind, 'bvh'>, bvh);
      expect(made.kind).toBe(kind);
      expect(dofsOf(made).length).toBeGreaterThanOrEqual(kind === 'fixed' ? 0 : 1);
    }
  });
});

describe('the DOFs of a compound joint, typed', () => {
  it('are taken in their order, whatever is between them', () => {
    expect(typedCompound(' Ty, rx  sz ')).toEqual(['ty', 'rx', 'sz']);
  });

  it.each([
    ['', 'at least one'],
    ['rx rx', 'twice'],
    ['rx qw', 'none of'],
  ])('“%s” is refused', (text, why) => expect(typedCompound(text)).toContain(why));
});
