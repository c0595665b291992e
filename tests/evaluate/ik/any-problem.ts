/** Skeletons of all kinds of joints, poses and pins for fast-check, of sizes that a character has. */
import fc from 'fast-check';
import type { IkPin } from '../../../src/evaluate/ik/pins.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import type { Couple, Joint, Motion, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { bvhMotion, motion } from '../../formats/arbitraries.ts';
import { joint } from '../../helpers/builders.ts';

/** In hundredths: what is 1e-200 long is another matter (see the degenerate cases). */
const part = fc.integer({ min: -100, max: 100 }).map((n) => n / 100);
export const vec3: fc.Arbitrary<Vec3> = fc.tuple(part, part, part);
export const turn = fc
  .tuple(part, part, part, part)
  .filter((q) => Math.hypot(...q) > 0.1)
  .map((q): readonly [number, number, number, number] => q);

const isTame = (of: Motion) => of.kind !== 'screw' || Math.abs(of.pitch) < 3;

/** Away from where a quaternion or a scale is nothing. */
function anyValue(name: string): fc.Arbitrary<number> {
  if (name.startsWith('s')) return fc.double({ min: 0.5, max: 2, noNaN: true });
  if (name === 'qw') return fc.double({ min: 0.4, max: 1, noNaN: true });
  return fc.double({ min: -1.5, max: 1.5, noNaN: true });
}

function anyJoint(index: number, limited: boolean): fc.Arbitrary<Joint> {
  return fc
    .oneof(motion, bvhMotion)
    .filter(isTame)
    .chain((own) => {
      const dofs = dofsOf(own);
      const limit = ({ name, rest }: { name: string; rest: number }) =>
        fc
          .tuple(anyValue(name), fc.double({ min: 0.1, max: 1, noNaN: true }))
          .map(([middle, half]) =>
            limited ? { min: middle - half, max: middle + half } : { min: rest - 1e5, max: rest + 1e5 },
          );
      return fc
        .record({
          parent: fc.integer({ min: 0, max: Math.max(0, index - 1) }),
          offset: vec3,
          limits: fc.tuple(...dofs.map(limit)),
          pose: fc.tuple(...dofs.map(({ name }) => anyValue(name))),
        })
        .map(({ parent, ...more }) => joint(index === 0 ? -1 : parent, { motion: own, ...more }));
    });
}

/** Some DOFs follow the first one of the joint before. */
function coupled(joints: readonly Joint[], gains: readonly number[]): readonly Joint[] {
  return joints.map((own, j) => {
    const [dof] = dofsOf(own.motion);
    const [follows] = j > 0 ? dofsOf(joints[j - 1].motion) : [];
    if (!dof || !follows || gains[j] === 0 || own.motion.kind === 'quaternion') return own;
    const couples: readonly Couple[] = [
      { dof: dof.name, joint: j - 1, follows: follows.name, gain: gains[j], offset: 0.7 },
    ];
    return { ...own, couples };
  });
}

/** In pre-order: the parent of each is the joint before or one above that. */
export const anySkeleton = (limited: boolean): fc.Arbitrary<Skeleton> =>
  fc
    .integer({ min: 1, max: 7 })
    .chain((n) =>
      fc.tuple(
        fc.tuple(...Array.from({ length: n }, (_, i) => anyJoint(i, limited))),
        fc.array(fc.constantFrom(0, 0, 0, 0.6, -0.8), { minLength: n, maxLength: n }),
      ),
    )
    .map(([joints, gains]) => {
      const parents: number[] = [];
      joints.forEach(({ parent }, i) => {
        const line: number[] = [];
        for (let j = i - 1; j >= 0; j = parents[j]) line.push(j);
        parents.push(i === 0 ? -1 : line[parent % line.length]);
      });
      return {
        name: 'any',
        joints: coupled(
          joints.map((own, i) => ({ ...own, parent: parents[i] })),
          gains,
        ),
      };
    });

export const anyPins = ({ joints }: Skeleton): fc.Arbitrary<readonly IkPin[]> =>
  fc.array(
    fc.record(
      {
        joint: fc.nat(joints.length - 1),
        point: vec3,
        target: vec3,
        orientation: turn,
        weight: fc.double({ min: 0.1, max: 3, noNaN: true }),
        holds: fc.boolean(),
      },
      { requiredKeys: ['joint', 'point', 'target'] },
    ),
    { minLength: 1, maxLength: 4 },
  );

export interface AnyProblem {
  readonly skeleton: Skeleton;
  readonly pins: readonly IkPin[];
}

export const anyProblem = (limited: boolean): fc.Arbitrary<AnyProblem> =>
  anySkeleton(limited).chain((skeleton) => anyPins(skeleton).map((pins) => ({ skeleton, pins })));
