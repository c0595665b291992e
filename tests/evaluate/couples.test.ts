import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { applyConstraints, compileSkeleton } from '../../src/evaluate/kinematics.ts';
import { poseAt } from '../../src/evaluate/pose.ts';
import { readSkel } from '../../src/formats/skel/read.ts';
import { coupleOf, couplesOf } from '../../src/model/skeleton/couples.ts';
import { firstDofs } from '../../src/model/skeleton/dofs.ts';
import type { Skeleton } from '../../src/model/skeleton/skeleton.ts';
import { skeleton as anySkeleton } from '../formats/arbitraries.ts';
import { character, joint } from '../helpers/builders.ts';

function skel(text: string): Skeleton {
  const [skeleton] = readSkel(text, 'hero.skel').value ?? [];
  if (!skeleton) throw new Error('the text is no skeleton');
  return skeleton;
}
/** What becomes of values for the joints' DOFs. */
function settled(skeleton: Skeleton, values: readonly number[], clamps = true): number[] {
  const compiled = compileSkeleton(skeleton);
  const dofs = Float64Array.of(...new Array<number>(compiled.firstDof[0]).fill(0), ...values);
  applyConstraints(compiled, dofs, clamps);
  return [...dofs.subarray(compiled.firstDof[0])];
}

describe('a coupled DOF', () => {
  const two = skel('hingejoint a { limit r -1 1 hingejoint b { couple r a.r 2 0.5 limit r -9 2 } }');

  it('follows the other after that one’s limits, within its own, whatever its own value', () => {
    expect(settled(two, [0.25, 7])).toEqual([0.25, 1]);
    expect(settled(two, [5, 7])).toEqual([1, 2]);
    expect(settled(two, [-5, 7])).toEqual([-1, -1.5]);
  });

  it('follows all the same where limits are not held', () => {
    expect(settled(two, [5, 7], false)).toEqual([5, 10.5]);
  });

  it('a coupled DOF is played and posed so', () => {
    const hero = character({ skeleton: two, pose: [0, 0, 0, 0.25, 7] });
    const out = new Float64Array(5);
    poseAt(hero, 0, out);
    expect([...out]).toEqual([0, 0, 0, 0.25, 1]);
    poseAt({ ...hero, clampsToLimits: false, pose: [0, 0, 0, 3, 7] }, 0, out);
    expect(out[4]).toBe(6.5);
  });

  it('follows one that follows another, even if it comes before both', () => {
    const chain = skel('balljoint a { couple rx b.rx 2 0 balljoint b { couple rx b.rz -1 1 limit rx -1 1 } }');
    expect(settled(chain, [9, 0, 0, 9, 0, 0.5])).toEqual([1, 0, 0, 0.5, 0, 0.5]);
    expect(settled(chain, [9, 0, 0, 9, 0, 5])).toEqual([-2, 0, 0, -1, 0, 5]);
  });

  it('a coupled DOF is found by its index, and no other', () => {
    expect(coupleOf(two, 4)).toEqual({ dof: 4, follows: 3, gain: 2, offset: 0.5 });
    expect(coupleOf(two, 3)).toBeUndefined();
    expect(coupleOf(undefined, 0)).toBeUndefined();
  });
});

describe('are sorted so that each follows a final value', () => {
  const couple = (dof: string, of: number, follows: string) => ({ dof, joint: of, follows, gain: 1, offset: 0 });
  const chain = (...couples: readonly ReturnType<typeof couple>[][]): Skeleton => ({
    name: 'hero',
    joints: couples.map((own, j) => joint(j - 1, { couples: own })),
  });

  it('are sorted so that each follows a final value come in an order in which each follows what is settled', () => {
    fc.assert(
      fc.property(anySkeleton, (skeleton) => {
        const { ordered, circular } = couplesOf(skeleton);
        const all = new Set(ordered.map(({ dof }) => dof));
        const before = new Set<number>();
        for (const { dof, follows } of ordered) {
          expect(before.has(follows) || !all.has(follows)).toBe(true);
          before.add(dof);
        }
        const written = skeleton.joints.reduce((sum, { couples = [] }) => sum + couples.length, 0);
        expect(ordered.length + circular.length).toBe(written);
        expect(circular).toEqual([]);
      }),
    );
  });

  it('couples of a skeleton made by hand are skipped if they are circular, with all that follow them', () => {
    const round = chain(
      [couple('rx', 1, 'rx')],
      [couple('rx', 0, 'rx')],
      [couple('rx', 1, 'rx'), couple('ry', 2, 'rz')],
    );
    const [a, b, c] = firstDofs(round);
    expect(
      couplesOf(round)
        .circular.map(({ dof }) => dof)
        .sort(),
    ).toEqual([a, b, c]);
    expect(couplesOf(round).ordered).toEqual([{ dof: c + 1, follows: c + 2, gain: 1, offset: 0 }]);
  });

  it('couples of a skeleton made by hand are left out where they name what is not there', () => {
    expect(couplesOf(chain([couple('rx', 5, 'rx'), couple('sx', 0, 'rx'), couple('ry', 0, 'tx')])).ordered).toEqual([]);
  });
});
