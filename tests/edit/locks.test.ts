/** Locked DOFs: everything that poses and keys by hand leaves them alone, and says how many they are. */
import { describe, expect, it } from 'vitest';
import type { Change } from '../../src/edit/change.ts';
import { setLocked } from '../../src/edit/commands/beside/sets.ts';
import { keyPose } from '../../src/edit/commands/keying.ts';
import { keyForMoment } from '../../src/edit/commands/moment.ts';
import { resetPose, setDofs, tweenPose } from '../../src/edit/commands/pose.ts';
import { applyPose, mirrorPose, pastePose } from '../../src/edit/commands/poses.ts';
import { poseByNames } from '../../src/edit/pose/by-names.ts';
import { Store } from '../../src/edit/store.ts';
import { Pull } from '../../src/evaluate/ik/drag/pull.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { poseAt } from '../../src/evaluate/pose.ts';
import type { Document } from '../../src/model/document.ts';
import { shownTake } from '../../src/model/document.ts';
import { keysOf, type Take } from '../../src/model/takes/take.ts';
import { character, documentOf, joint, takeOfValues } from '../helpers/builders.ts';
import { channelOf } from './keys/channels.ts';

const NOW = { characterId: 'c1', timeSeconds: 0.5 };
const SIDES = [
  joint(-1, { name: 'body' }),
  joint(0, { name: 'arm_l', offset: [1, 0, 0] }),
  joint(0, { name: 'arm_r', offset: [-1, 0, 0] }),
];
const DOFS = 12;
/** rx and ry of arm_l, rz of arm_r. */
const LOCKS = [6, 7, 11];
const wave = channelOf([
  [0, 0],
  [1, 1],
]);
const WALK: Take = { ...takeOfValues('walk', Array<number>(DOFS).fill(0)), channels: Array(DOFS).fill(wave) };
const hero = character({ skeleton: { name: 'hero', joints: SIDES }, takes: [WALK], shownTake: 0 });
const pose = Array.from({ length: DOFS }, (_, d) => 0.1 * (d + 1));
const still = {
  ...hero,
  takes: [],
  shownTake: -1,
  pose,
  poses: [{ name: 'zero', values: Array<number>(DOFS).fill(0) }],
};
const locked = (of = hero) =>
  setLocked.run(documentOf(of), { characterId: 'c1', dofs: LOCKS, locked: true }) as Document;

/** The document after a change, and the number of locked DOFs that it says. */
function told(change: Document | Change) {
  if ('characters' in change) throw new Error('Nothing is said of locks.');
  return { character: change.document.characters[0], locked: change.locked };
}

function shownOf({ characters: [first] }: Document, timeSeconds = NOW.timeSeconds): readonly number[] {
  const out = new Float64Array(DOFS);
  poseAt(first, timeSeconds, out);
  return [...out];
}

describe('locked DOFs', () => {
  const all = pose.map((value, index) => ({ index, value }));

  it('sliders and drags leave them alone, with auto-key too', () => {
    const set = told(setDofs.run(locked(still), { ...NOW, dofs: all.map((dof) => ({ ...dof, value: 2 })) }));
    expect(set.locked).toBe(3);
    expect(set.character.pose.map((value) => value === 2)).toEqual(pose.map((_, d) => !LOCKS.includes(d)));
    const keyed = told(setDofs.run(locked(), { ...NOW, dofs: all, key: {} }));
    expect(keyed.locked).toBe(3);
    const counts = shownTake(keyed.character)?.channels.map((c) => keysOf(c).times.length);
    expect(counts).toEqual(pose.map((_, d) => (LOCKS.includes(d) ? 2 : 3)));
  });

  it('K keys the others, a moment eases the others', () => {
    const keyed = told(keyPose.run(locked(), NOW));
    expect(keyed.locked).toBe(3);
    expect(shownTake(keyed.character)?.channels.map((c) => keysOf(c).times.length)).toEqual(
      pose.map((_, d) => (LOCKS.includes(d) ? 2 : 3)),
    );
    const moment = told(keyForMoment.run(locked(), { ...NOW, dofs: all, easeIn: 0.1, easeOut: 0.1 }));
    expect(moment.locked).toBe(3);
    expect(shownTake(moment.character)?.channels[6]).toBe(wave);
  });

  it('pasting, applying, mirroring, resetting and tweening leave them alone', () => {
    const before = locked(still);
    const zero = poseByNames(still, { name: 'zero', values: Array<number>(DOFS).fill(0) });
    for (const change of [
      pastePose.run(before, { ...NOW, pose: zero }),
      applyPose.run(before, { ...NOW, pose: 0 }),
      mirrorPose.run(before, { ...NOW, way: 'swap' }),
      resetPose.run(before, { ...NOW, to: 'zero' }),
    ]) {
      const { character: after, locked: count } = told(change);
      expect(count).toBe(3);
      for (const dof of LOCKS) expect(after.pose[dof]).toBe(pose[dof]);
      expect(after.pose[3]).not.toBe(pose[3]);
    }
    const tweened = told(tweenPose.run(locked(), { ...NOW, u: 0 }));
    expect(tweened.locked).toBe(3);
    expect(tweened.character.unkeyed?.dofs).toEqual(pose.flatMap((_, d) => (LOCKS.includes(d) ? [] : [d])));
  });

  it('where all are locked, it says so and changes nothing', () => {
    const given = { ...NOW, dofs: [{ index: 6, value: 2 }] };
    expect(() => setDofs.run(locked(), given)).toThrow('This DOF is locked');
    expect(() => keyPose.run(locked(), { ...NOW, dofs: [6, 7] })).toThrow('All 2 DOFs are locked');
  });

  it('playback moves them', () => {
    expect(shownOf(locked(), 0.5)).toEqual(shownOf(documentOf(hero), 0.5));
  });

  it('IK leaves them alone, and bends the others', () => {
    const [of] = locked({ ...still, pose: Array<number>(DOFS).fill(0) }).characters;
    const { skeleton } = of;
    if (!skeleton) throw new Error('It has a skeleton.');
    const dofs = new Float64Array(DOFS);
    const compiled = compileSkeleton(skeleton);
    const world = new Float64Array(16 * compiled.jointCount);
    worldMatrices(compiled, dofs, world);
    const pull = new Pull(of, skeleton, { dofs, world }, new Map(), { joint: 1, point: [1, 0, 0] });
    pull.to([1.5, 2, 0.5]);
    pull.settle();
    expect(LOCKS.map((dof) => pull.dofs[dof])).toEqual([0, 0, 0]);
    expect(pull.dofs.some((value) => value !== 0)).toBe(true);
  });

  it('a step tells its listeners how many it has left alone, after a drag too', () => {
    const store = new Store(locked(still));
    const heard: number[] = [];
    store.onStep((_now, _before, count) => heard.push(count));
    store.apply(setDofs, { ...NOW, dofs: all.map((dof) => ({ ...dof, value: 1 })) });
    const drag = store.begin('Rotate');
    drag.preview(
      setDofs.run(store.document, {
        ...NOW,
        dofs: [
          { index: 3, value: 2 },
          { index: 6, value: 2 },
        ],
      }),
    );
    drag.commit();
    store.apply(setDofs, { ...NOW, dofs: [{ index: 3, value: 4 }] });
    expect(heard).toEqual([3, 1, 0]);
  });
});
