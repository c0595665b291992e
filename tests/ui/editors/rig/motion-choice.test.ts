import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../../src/evaluate/kinematics.ts';
import { dofsOf, EULER_ORDERS, type Motion, UNLIMITED } from '../../../../src/model/skeleton.ts';
import {
  MOTION_LABELS,
  type MotionKind,
  motionOfKind,
  typedCompound,
} from '../../../../src/ui/editors/rig/motion-choice.ts';
import { joint } from '../../builders.ts';

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

  it('made of chosen DOFs moves as before, and turned back it is what it was', () => {
    for (const order of EULER_ORDERS) {
      const compound = motionOfKind('compound', { kind: 'ball', order });
      expect(motionOfKind('ball', compound)).toEqual({ kind: 'ball', order });
    }
    expect(motionOfKind('compound', { kind: 'ball', order: 'xyz' })).toEqual({
      kind: 'compound',
      dofs: ['rz', 'ry', 'rx'],
    });
    expect(motionOfKind('compound', { kind: 'free', order: 'zxy' })).toEqual({
      kind: 'compound',
      dofs: ['tx', 'ty', 'tz', 'ry', 'rx', 'rz'],
    });
    expect(motionOfKind('universal', motionOfKind('compound', { kind: 'universal', order: 'yz' }))).toEqual({
      kind: 'universal',
      order: 'yz',
    });
  });

  it('made of chosen DOFs turns its space exactly as before', () => {
    const values = [0.3, -0.8, 1.1];
    const matrixOf = (motion: Motion, angles: Readonly<Record<string, number>>) => {
      const own = joint('one', -1);
      const pose = dofsOf(motion).map(({ name }) => angles[name]);
      const world = new Float64Array(16);
      const skeleton = { name: 's', joints: [{ ...own, motion, pose, limits: pose.map(() => UNLIMITED) }] };
      worldMatrices(compileSkeleton(skeleton), Float64Array.from([0, 0, 0, ...pose]), world);
      return [...world];
    };
    for (const order of EULER_ORDERS) {
      const ball: Motion = { kind: 'ball', order };
      const angles = { rx: values[0], ry: values[1], rz: values[2] };
      const [was, is] = [ball, motionOfKind('compound', ball)].map((motion) => matrixOf(motion, angles));
      is.forEach((x, i) => {
        expect(Math.abs(x - was[i])).toBeLessThan(1e-14);
      });
    }
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
