/** Locked DOFs: everything that poses and keys by hand leaves them alone, and says how many they are. */
import { describe, expect, it } from 'vitest';
import type { Change } from '../../src/edit/change.ts';
import { setLocked } from '../../src/edit/commands/beside/sets.ts';
import { resample } from '../../src/edit/commands/channels.ts';
import { setExtrapolation } from '../../src/edit/commands/extrapolation.ts';
import { keyPose } from '../../src/edit/commands/keying.ts';
import {
  addKey,
  insertKeys,
  moveKeys,
  removeKeys,
  rippleKeys,
  scaleKeys,
  setKeys,
  tweenKeys,
} from '../../src/edit/commands/keys.ts';
import { keyForMoment } from '../../src/edit/commands/moment.ts';
import { pasteKeys } from '../../src/edit/commands/paste.ts';
import { resetPose, setDofs, tweenPose } from '../../src/edit/commands/pose.ts';
import { applyPose, mirrorPose, pastePose } from '../../src/edit/commands/poses.ts';
import { setTangents } from '../../src/edit/commands/tangents.ts';
import { copyKeys } from '../../src/edit/keys/clipboard.ts';
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

const C1 = { characterId: 'c1' };
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
/** Its middle key is between others. */
const HILL = channelOf([
  [0, 0],
  [1, 4],
  [2, 1],
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

  const keys = Array.from({ length: DOFS }, (_, channel) => ({ channel, indices: [1] }));
  const copied = copyKeys(WALK, keys);
  it.each<[string, (document: Document) => Document | Change]>([
    ['moved', (d) => moveKeys.run(d, { ...C1, keys, seconds: 0.5, values: keys.map(() => 1) })],
    ['scaled', (d) => scaleKeys.run(d, { ...C1, keys, valueFactor: 2 })],
    ['tweened', (d) => tweenKeys.run(d, { ...C1, keys: keys.map((k) => ({ ...k, indices: [1] })), u: 0.5 })],
    ['set', (d) => setKeys.run(d, { ...C1, keys, value: 5 })],
    ['deleted', (d) => removeKeys.run(d, { ...C1, keys, timeSeconds: 0 })],
    ['rippled', (d) => rippleKeys.run(d, { ...C1, keys, seconds: 1 })],
    ['given tangents', (d) => setTangents.run(d, { ...C1, keys, side: 'both', kind: 'linear' })],
    ['inserted', (d) => insertKeys.run(d, { ...C1, channels: [...keys.keys()], timeSeconds: 0.5 })],
    ['pasted', (d) => pasteKeys.run(d, { ...NOW, copied, timeSeconds: 5, mode: 'merge' })],
    [
      'resampled',
      (d) =>
        resample.run(d, { ...C1, channels: [...keys.keys()], framesPerSecond: 4, from: 0, to: 2, tangents: 'linear' }),
    ],
    [
      'extrapolated',
      (d) => setExtrapolation.run(d, { ...C1, channels: [...keys.keys()], side: 'out', extrapolation: 'linear' }),
    ],
  ])('keep their curves when keys are %s, and how many is told', (_, run) => {
    const start = locked({ ...hero, takes: [{ ...WALK, channels: Array(DOFS).fill(HILL) }] });
    const { character: after, locked: count } = told(run(start));
    expect(count).toBe(LOCKS.length);
    shownTake(after)?.channels.forEach((channel, d) => {
      if (LOCKS.includes(d)) expect(channel).toBe(HILL);
      else expect(channel).not.toBe(HILL);
    });
  });

  it('keep their keys selected, and refuse edits of nothing else', () => {
    const store = new Store(locked());
    store.select({ characterId: 'c1', keys });
    store.apply(moveKeys, { ...C1, keys, seconds: 0.5 });
    expect(store.selection.keys).toEqual(keys);
    expect(() => moveKeys.run(locked(), { ...C1, keys: [keys[6], keys[7]], seconds: 1 })).toThrow(
      'All 2 DOFs are locked',
    );
    expect(() => addKey.run(locked(), { ...NOW, channel: 6, value: 3 })).toThrow('This DOF is locked');
  });

  it('a step tells its listeners how many it has left alone, after a drag too', () => {
    const store = new Store(locked(still));
    const heard: number[] = [];
    store.onStep((_now, _before, { locked = 0 }) => heard.push(locked));
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
