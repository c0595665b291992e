/**
 * Live retargeting of one pose: a take of 60 joints onto the walker's 29. Against the necessary parts: the source's
 * pose and world matrices, and the target's. Most of the time is fitting within limits: 4.5 times that with limits, 2.5
 * times without.
 */
import { bench, describe } from 'vitest';
import { WALKER_SKELETON } from '../../examples/characters/walker/skeleton.ts';
import { worldMatrices } from '../../src/evaluate/kinematics.ts';
import { planRetarget } from '../../src/evaluate/retarget/make-plan.ts';
import { automaticPairs } from '../../src/evaluate/retarget/match.ts';
import { retargetPose } from '../../src/evaluate/retarget/retarget-pose.ts';
import { sourcePose } from '../../src/evaluate/retarget/source-pose.ts';
import { jointDofCount } from '../../src/model/skeleton/dofs.ts';
import { driverOf, PARTS, person, takeOfRows } from '../evaluate/retarget/people.ts';

const body = person();
/** With fingers that nothing follows, to have 60 joints. */
const source = {
  ...body,
  joints: [
    ...body.joints,
    ...Array.from({ length: 60 - PARTS.length }, (_, i) => ({
      ...body.joints[1],
      name: '',
      parent: PARTS.indexOf(i % 2 === 0 ? 'left hand' : 'right hand'),
    })),
  ],
};
const FRAMES = 240;
const rows = Array.from({ length: FRAMES }, (_, f) =>
  Array.from({ length: jointDofCount(source) }, (_, d) => (d === 1 ? 0.9 : d < 3 ? 0 : 0.4 * Math.sin(f / 9 + d))),
);
const take = takeOfRows(source, rows, 1 / 60);
const driver = driverOf(source, take, automaticPairs(source, WALKER_SKELETON));
const held = planRetarget(driver, WALKER_SKELETON, undefined, true);
const free = planRetarget(driver, WALKER_SKELETON, undefined, false);
const dofs = Float64Array.from(held.restDofs);

let frame = 0;
/** Between frames, so that rotations have to be interpolated. */
const now = () => ((frame++ % FRAMES) + 0.5) / 60;

describe('a take of 60 joints on a character of 29', () => {
  bench('ours, within limits', () => retargetPose(held, now(), dofs));
  bench('ours, without limits', () => retargetPose(free, now(), dofs));
  bench('both poses and their matrices alone', () => {
    sourcePose(held.played, now(), held.dofs);
    worldMatrices(held.source, held.dofs, held.sourceWorld);
    worldMatrices(held.target, dofs, held.targetWorld);
  });
});
