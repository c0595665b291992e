import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { Pull } from '../../../../src/evaluate/ik/drag/pull.ts';
import { pinTargets, pointAt } from '../../../../src/evaluate/ik/set-up.ts';
import { applyConstraints, compileSkeleton, worldMatrices } from '../../../../src/evaluate/kinematics.ts';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import type { IkSetup } from '../../../../src/model/ik.ts';
import { coupleOf } from '../../../../src/model/skeleton/couples.ts';
import { characterDofs, filePose } from '../../../../src/model/skeleton/dofs.ts';
import { type Skeleton, UNLIMITED } from '../../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../../helpers/builders.ts';
import { character } from '../../../ui/builders.ts';
import { anySkeleton, vec3 } from '../any-problem.ts';

/** Of the reach: what the hand goes in a frame. */
const STEP = 0.01;
const STEPS = 15;
/** Radians in a frame: what the shown pose goes at most, twice if putting the pins in order needs it. */
const NO_JUMP = 0.31;
/** Of limits: rounding. */
const NEAR = 1e-9;

interface Drag {
  readonly skeleton: Skeleton;
  readonly dragged: number;
  readonly pinned: number;
  readonly point: Vec3;
  readonly way: Vec3;
  readonly rootIsFree: boolean;
}

const anyDrag = fc.boolean().chain((limited) =>
  anySkeleton(limited).chain((skeleton) =>
    fc.record({
      skeleton: fc.constant(skeleton),
      dragged: fc.nat(skeleton.joints.length - 1),
      pinned: fc.nat(skeleton.joints.length - 1),
      point: vec3,
      way: vec3,
      rootIsFree: fc.boolean(),
    }),
  ),
);

/** Where putting the pins in order takes a turn of 2: the point is held by one pin and pulled at, on one and the same joint. */
const LOOSE = Array.from({ length: 5 }, () => UNLIMITED);
const BOLD: Drag = {
  skeleton: {
    name: 'bold',
    joints: [
      joint(-1, { offset: [0.49, -0.08, 0.74], motion: { kind: 'shear' }, limits: LOOSE.slice(2), pose: [0, 0, 0] }),
      joint(0, {
        offset: [0.06, 0.05, -0.75],
        motion: { kind: 'bvh', channels: ['rz', 'ty', 'ry', 'tz', 'tx'], positions: 'add' },
        limits: LOOSE,
        pose: [0, 0, 0, 0, 0],
        couples: [{ dof: 'rz', joint: 0, follows: 'hxy', gain: -0.8, offset: 0.7 }],
      }),
    ],
  },
  dragged: 1,
  pinned: 1,
  point: [0, -1, 0.01],
  way: [0.12, 0.4, -0.69],
  rootIsFree: true,
};

/** What is seen of each frame of a drag, and of its release. */
function pull({ skeleton, dragged, pinned, point, way, rootIsFree }: Drag, look: (dofs: Float64Array) => void): void {
  const ik: IkSetup = {
    pins: [{ id: 1, joint: pinned, point: [0, 0.1, 0], weight: 1, holdsOrientation: false }],
    stiff: [],
    rootIsFree,
  };
  const one = character({ skeleton, ik });
  const compiled = compileSkeleton(skeleton);
  const start = filePose(skeleton, 0).slice();
  const world = new Float64Array(16 * compiled.jointCount);
  const dofs = Float64Array.from(start);
  applyConstraints(compiled, dofs, true);
  worldMatrices(compiled, dofs, world);
  const [x, y, z] = pointAt(world, dragged, point);
  const hand = new Pull(one, skeleton, { dofs, world }, pinTargets(ik, world), { joint: dragged, point });
  const size = (STEP * hand.reach) / (Math.hypot(...way) || 1);
  look(hand.dofs);
  for (let i = 1; i <= STEPS; i++) {
    hand.to([x + i * size * way[0], y + i * size * way[1], z + i * size * way[2]]);
    look(hand.dofs);
  }
  hand.settle();
  look(hand.dofs);
}

describe('a pull on any skeleton', () => {
  it('a pull on any skeleton has numbers, stays within the limits and does not jump, whatever the joints', () => {
    fc.assert(
      fc.property(anyDrag, (drag) => {
        const all = characterDofs(drag.skeleton, []);
        let before: Float64Array | undefined;
        pull(drag, (dofs) => {
          expect(dofs.every(Number.isFinite)).toBe(true);
          all.forEach(({ limit, unit }, d) => {
            const holds = limit.min <= limit.max && !coupleOf(drag.skeleton, d);
            if (holds && (dofs[d] < limit.min - NEAR || dofs[d] > limit.max + NEAR)) {
              expect.fail(`DOF ${d} is ${dofs[d]}, its limits ${limit.min} and ${limit.max}`);
            }
            const change = before && unit === 'angle' ? Math.abs(dofs[d] - before[d]) : 0;
            if (change > NO_JUMP) expect.fail(`DOF ${d} jumps by ${change}`);
          });
          before = dofs.slice();
        });
      }),
      { examples: [[BOLD]] },
    );
  });
});
