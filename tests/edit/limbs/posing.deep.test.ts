/** Posing limbs in IK: their goals move, and hold while the rest of the body does. */
import { describe, expect, it } from 'vitest';
import { switchLimb } from '../../../src/edit/commands/beside/limbs.ts';
import { moveByIk } from '../../../src/edit/commands/drags/drags.ts';
import { keyPose } from '../../../src/edit/commands/keying.ts';
import { resetPose, setDofs } from '../../../src/edit/commands/pose.ts';
import { applyPose, keepPose } from '../../../src/edit/commands/poses.ts';
import { discardUnkeyed } from '../../../src/edit/commands/unkeyed.ts';
import { mirroredSetDofs } from '../../../src/edit/pose/live-mirror.ts';
import { posedDofs } from '../../../src/edit/posed-dofs.ts';
import { limbInfos } from '../../../src/evaluate/limbs/infos.ts';
import { dofCountOf } from '../../../src/evaluate/pose.ts';
import type { Document } from '../../../src/model/document.ts';
import { firstDofs } from '../../../src/model/skeleton/dofs.ts';
import { firstGoalChannel, goalChannel } from '../../../src/model/takes/goals.ts';
import { expectClose } from '../../helpers/close.ts';
import { HERO, heroOf, LEG, run, WALKER, withLegs, worldAt } from './walker.ts';

const at = (timeSeconds: number) => ({ ...HERO, timeSeconds });
const FOOT = LEG[2];
const KEY = { tangents: 'smooth', playedRange: [0, 2] } as const;

/** The left leg in IK from the beginning. */
const inIk = () => run(withLegs(), switchLimb, { ...at(0), limb: 0, to: 'ik' });
const footAt = (document: Document, time: number) => [...worldAt(document, time).slice(16 * FOOT, 16 * FOOT + 16)];
const pivotAt = (document: Document, time: number) => footAt(document, time).slice(12, 15);
const goalIn = (document: Document) => heroOf(document).takes[0].goals?.list[0];

function moved(document: Document, [x, y, z]: readonly number[], by: readonly number[]) {
  return run(document, moveByIk, { ...at(0), joint: FOOT, to: [x + by[0], y + by[1], z + by[2]] });
}

describe('a limb in IK', () => {
  it('dragged by its foot moves its goal, not keyed at first; K keys the goal, and another time discards it', () => {
    const before = inIk();
    const from = pivotAt(before, 0);
    const dragged = moved(before, from, [0.02, 0.05, 0.03]);
    expectClose(pivotAt(dragged, 0), [from[0] + 0.02, from[1] + 0.05, from[2] + 0.03], 1e-4);
    const hero = heroOf(dragged);
    expect(hero.takes).toBe(heroOf(before).takes);
    const first = firstGoalChannel(dofCountOf(hero), 0);
    expect(hero.unkeyed?.dofs.filter((dof) => dof < first)).toEqual([]);
    expect(limbInfos(hero, 0)[0].gap).toBeLessThan(1e-5);
    expect(footAt(dragged, 0.5)).toEqual(footAt(before, 0.5));
    const posed = posedDofs(hero, undefined, 0);
    const keyed = run(dragged, keyPose, { ...at(0), dofs: posed });
    expect(heroOf(keyed).unkeyed).toBeUndefined();
    expectClose(footAt(keyed, 0), footAt(dragged, 0), 1e-9);
    expect(heroOf(keyed).takes[0].channels).toBe(hero.takes[0].channels);
    expect(footAt(run(dragged, discardUnkeyed, { exceptSeconds: 1 }), 0)).toEqual(footAt(before, 0));
  });

  it('with auto-key keys the goal, and no joint of the limb', () => {
    const before = inIk();
    const [x, y, z] = pivotAt(before, 0);
    const keyed = run(before, moveByIk, { ...at(0.5), joint: FOOT, to: [x, y + 0.06, z], key: KEY });
    const goal = goalIn(keyed);
    const ty = goal && goalChannel(goal, 'ty');
    expect(ty).toMatchObject({ kind: 'keys', times: Float64Array.of(0, 0.5) });
    expect(heroOf(keyed).takes[0].channels).toBe(heroOf(before).takes[0].channels);
    expectClose(pivotAt(keyed, 0.5), [x, y + 0.06, z], 1e-4);
  });

  it('holds its foot while the root is moved, by a DOF or by IK of the whole body', () => {
    const before = inIk();
    const foot = footAt(before, 0);
    const lowered = run(before, setDofs, { ...at(0), dofs: [{ index: 1, value: -0.05 }] });
    expectClose(footAt(lowered, 0), foot, 1e-7);
    const hips = WALKER.joints.findIndex(({ name }) => name === 'hips');
    const world = worldAt(before, 0);
    const [x, y, z] = world.slice(16 * hips + 12, 16 * hips + 15);
    const dragged = run(before, moveByIk, { ...at(0), joint: hips, to: [x + 0.02, y - 0.04, z], reach: 'body' });
    expectClose(footAt(dragged, 0), foot, 1e-7);
    expect(goalIn(dragged)).toBe(goalIn(before));
  });

  it('goes where a slider, a saved pose, or the mirror of the other side puts it', () => {
    const before = inIk();
    const shin = firstDofs(WALKER)[LEG[1]];
    const bent = run(before, setDofs, { ...at(0), dofs: [{ index: shin, value: 1.2 }] });
    expect(limbInfos(heroOf(bent), 0)[0].gap).toBeLessThan(1e-6);
    const plain = run(withLegs(), setDofs, { ...at(0), dofs: [{ index: shin, value: 1.2 }] });
    expectClose(footAt(bent, 0), footAt(plain, 0), 1e-7);
    const kept = run(plain, keepPose, { ...at(0), name: 'bent' });
    const held = run(kept, switchLimb, { ...at(0.5), limb: 0, to: 'ik' });
    const applied = run(held, applyPose, { ...at(0.7), pose: 0 });
    expectClose(footAt(applied, 0.7), footAt(run(kept, applyPose, { ...at(0.7), pose: 0 }), 0.7), 1e-6);
    const right = firstDofs(WALKER)[WALKER.joints.findIndex(({ name }) => name === 'shin_r')];
    const mirrored = run(before, mirroredSetDofs, { ...at(0), dofs: [{ index: right, value: 1 }] });
    expect(footAt(mirrored, 0)).not.toEqual(footAt(before, 0));
    expect(heroOf(mirrored).unkeyed?.dofs.length).toBeGreaterThan(5);
    expectClose(
      footAt(run(before, resetPose, { ...at(0), to: 'file' }), 0),
      footAt(run(withLegs(), resetPose, { ...at(0), to: 'file' }), 0),
      1e-6,
    );
  });
});

it('K of a joint of a limb in IK keys its goal, and of the whole pose all of both', () => {
  const before = inIk();
  const joint = firstDofs(WALKER)[FOOT];
  const keyed = run(before, keyPose, { ...at(0.5), dofs: [joint, joint + 1, joint + 2] });
  expect(heroOf(keyed).takes[0].channels).toBe(heroOf(before).takes[0].channels);
  expect(goalIn(keyed)?.channels.px?.curve).toMatchObject({ times: Float64Array.of(0, 0.5) });
  const whole = run(before, keyPose, at(0.5));
  expect(goalIn(whole)?.channels.rz?.curve).toMatchObject({ times: Float64Array.of(0, 0.5) });
  expectClose(footAt(whole, 0.5), footAt(before, 0.5), 1e-7);
});
