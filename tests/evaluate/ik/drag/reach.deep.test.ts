import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { dragReach } from '../../../../src/evaluate/ik/drag/drag-reach.ts';
import { Pull } from '../../../../src/evaluate/ik/drag/pull.ts';
import type { IkReach } from '../../../../src/evaluate/ik/limb.ts';
import { pinTargets, pointAt } from '../../../../src/evaluate/ik/set-up.ts';
import { applyConstraints, compileSkeleton, worldMatrices } from '../../../../src/evaluate/kinematics.ts';
import { setIdentity } from '../../../../src/math/mat4.ts';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import type { IkSetup } from '../../../../src/model/ik.ts';
import { coupleOf } from '../../../../src/model/skeleton/couples.ts';
import { filePose } from '../../../../src/model/skeleton/dofs.ts';
import type { Skeleton } from '../../../../src/model/skeleton/skeleton.ts';
import { character } from '../../../ui/builders.ts';
import { anySkeleton, vec3 } from '../any-problem.ts';

const PLACED = new Float64Array(16);
setIdentity(PLACED);

interface Drag {
  readonly skeleton: Skeleton;
  readonly dragged: number;
  readonly pinned: number;
  readonly point: Vec3;
  readonly way: Vec3;
  readonly reach: IkReach;
}

const anyDrag: fc.Arbitrary<Drag> = fc.boolean().chain((limited) =>
  anySkeleton(limited).chain((skeleton) => {
    const anyJoint = fc.nat(skeleton.joints.length - 1);
    return fc.record({
      skeleton: fc.constant(skeleton),
      dragged: anyJoint,
      pinned: anyJoint,
      point: vec3,
      way: vec3,
      reach: fc.oneof(
        fc.constant('limb' as const),
        anyJoint.map((top) => ({ top })),
      ),
    });
  }),
);

describe('a pull with a reach', () => {
  it('changes no joint outside of it, and moves none that doesn’t hang on it', () => {
    let limbs = 0;
    fc.assert(
      fc.property(anyDrag, ({ skeleton, dragged, pinned, point, way, reach }) => {
        const ik: IkSetup = {
          pins: [{ id: 1, joint: pinned, point: [0, 0.1, 0], weight: 1, holdsOrientation: false }],
          stiff: [],
          rootIsFree: true,
        };
        const one = character({ skeleton, ik });
        const compiled = compileSkeleton(skeleton);
        const { firstDof, jointCount, parent, travel } = compiled;
        const dofs = Float64Array.from(filePose(skeleton, 0));
        const world = new Float64Array(16 * jointCount);
        applyConstraints(compiled, dofs, true);
        worldMatrices(compiled, dofs, world);
        const what = dragReach(one, skeleton, world, PLACED, dragged, reach);
        const { bending } = what;
        if (bending === 'body') return;
        limbs++;
        const grip = { joint: dragged, point };
        const pull = new Pull(one, skeleton, { dofs, world }, pinTargets(ik, world), grip, PLACED, what);
        const [x, y, z] = pointAt(world, dragged, point);
        for (let i = 1; i <= 3; i++) pull.to([x + 0.1 * i * way[0], y + 0.1 * i * way[1], z + 0.1 * i * way[2]]);
        pull.settle();
        const after = pull.dofs;
        for (const dof of travel) if (dof >= 0) expect(after[dof]).toBe(dofs[dof]);
        const moves: boolean[] = [];
        for (let j = 0; j < jointCount; j++) {
          const bends = bending.includes(j);
          let follows = false;
          for (let dof = firstDof[j]; dof < firstDof[j + 1]; dof++) {
            if (coupleOf(skeleton, dof)) follows = true;
            else if (!bends) expect(after[dof]).toBe(dofs[dof]);
          }
          moves[j] = bends || follows || (parent[j] >= 0 && moves[parent[j]]);
        }
        const now = new Float64Array(16 * jointCount);
        worldMatrices(compiled, after, now);
        for (let k = 0; k < now.length; k++) if (!moves[k >> 4]) expect(now[k]).toBe(world[k]);
      }),
    );
    expect(limbs).toBeGreaterThan(30);
  });
});
