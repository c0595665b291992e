import fc from 'fast-check';
import { expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { filePose, firstDofs } from '../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../src/model/skeleton/joint-types.ts';
import { skelMotionOf, skelSkeleton } from '../../src/model/skeleton/skel-motion.ts';
import { type BvhMotion, type Joint, type Skeleton, UNLIMITED } from '../../src/model/skeleton/skeleton.ts';
import { bvhMotion } from '../formats/arbitraries.ts';
import { joint, skeleton as plain } from '../helpers/builders.ts';
import { expectClose, WITHIN } from '../helpers/close.ts';

const value = fc.double({ min: -3, max: 3, noNaN: true });
const bvhJoint = (motion: BvhMotion, offset: readonly [number, number, number], values: readonly number[]): Joint => {
  const dofs = dofsOf(motion);
  return joint(-1, { motion, offset, pose: dofs.map((_, i) => values[i]), limits: dofs.map(() => UNLIMITED) });
};
const anyJoint = fc
  .tuple(bvhMotion, fc.tuple(value, value, value), fc.array(value, { minLength: 6, maxLength: 6 }))
  .map((parts) => bvhJoint(...parts));
const anySkeleton = fc
  .array(anyJoint, { minLength: 1, maxLength: 6 })
  .map((joints): Skeleton => ({ name: 'x', joints: joints.map((j, i) => ({ ...j, parent: i - 1 })) }));

function world(skeleton: Skeleton, dofs: readonly number[]): Float64Array {
  const out = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), Float64Array.from(dofs), out);
  return out;
}

it('a skeleton of BVH has the same joints in the same places with motions that .skel has', () => {
  fc.assert(
    fc.property(anySkeleton, (bvh) => {
      const made = skelSkeleton(bvh);
      expect(made.joints.some(({ motion }) => motion.kind === 'bvh')).toBe(false);
      expectClose(world(made, filePose(made, 0)), world(bvh, filePose(bvh, 0)), WITHIN.rounding);
    }),
  );
});

it('each of its DOFs is one of the channels that there were', () => {
  fc.assert(
    fc.property(anySkeleton, (bvh) => {
      const [from, to] = [firstDofs(bvh), firstDofs(skelSkeleton(bvh))];
      const [before, after] = [filePose(bvh, 0), filePose(skelSkeleton(bvh), 0)];
      bvh.joints.forEach(({ motion }, j) => {
        const { dofMap } = skelMotionOf(motion);
        expect([...dofMap].sort()).toEqual(dofMap.map((_, i) => i));
        expect(dofMap.map((_, i) => after[to[j] + i])).toEqual(dofMap.map((dof) => before[from[j] + dof]));
      });
    }),
  );
});

it('a skeleton without any of BVH is the very same', () => {
  const hero = plain(3);
  expect(skelSkeleton(hero)).toBe(hero);
});

it('links are in the order of the DOFs, also where this is another one', () => {
  const link = { joint: 0, follows: 'rx', gain: 1, offset: 0 };
  const motion: BvhMotion = { kind: 'bvh', channels: ['rx', 'ry', 'tx'], positions: 'add' };
  const couples = [
    { ...link, dof: 'ry' },
    { ...link, dof: 'tx' },
  ];
  const [after] = skelSkeleton({ name: 'x', joints: [{ ...bvhJoint(motion, [0, 0, 0], [0, 0, 0]), couples }] }).joints;
  expect(after.couples?.map(({ dof }) => dof)).toEqual(['tx', 'ry']);
});
