/** What is posed on one side, and set on the other one as *Copy to other side* would. */
import { describe, expect, it } from 'vitest';
import { documentIn } from '../../../src/edit/change.ts';
import { setLocked } from '../../../src/edit/commands/beside/sets.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { mirrorPose, pastePose } from '../../../src/edit/commands/poses.ts';
import { poseByNames } from '../../../src/edit/pose/by-names.ts';
import { mirroredSetDofs } from '../../../src/edit/pose/live-mirror.ts';
import { keysOf } from '../../../src/model/takes/take.ts';
import { character, documentOf, joint, takeOfValues } from '../../helpers/builders.ts';
import { expectEdit } from '../../helpers/expect-edit.ts';

const NOW = { characterId: 'c1', timeSeconds: 0 };
const SIDES = [
  joint(-1, { name: 'body' }),
  joint(0, { name: 'arm_l', offset: [1, 0, 0] }),
  joint(1, { name: 'hand_l', offset: [1, 0, 0] }),
  joint(0, { name: 'arm_r', offset: [-1, 0, 0] }),
  joint(3, { name: 'hand_r', offset: [-1, 0, 0] }),
];
const DOFS = 18;
/** The first DOF of each joint. */
const [BODY, ARM_L, HAND_L, ARM_R, HAND_R] = [3, 6, 9, 12, 15];
const hero = character({ skeleton: { name: 'hero', joints: SIDES }, pose: Array<number>(DOFS).fill(0) });
const still = documentOf(hero);
const turn = (first: number, values: readonly number[]) => values.map((value, i) => ({ index: first + i, value }));
const poseOf = (document: { characters: readonly { pose: readonly number[] }[] }) => document.characters[0].pose;
const at = (pose: readonly number[], first: number) => pose.slice(first, first + 3);

describe('live mirror', () => {
  it('what changes on one side is set on the partner, as by Copy to other side; nothing else is', () => {
    const dofs = turn(ARM_L, [0.2, 0.3, -0.4]);
    const mirrored = poseOf(documentIn(expectEdit(still, mirroredSetDofs, { ...NOW, dofs })));
    const set = documentIn(setDofs.run(still, { ...NOW, dofs }));
    const copied = poseOf(documentIn(mirrorPose.run(set, { ...NOW, joint: 1, way: 'toOther' })));
    expect(mirrored).toEqual(copied);
    expect(at(mirrored, ARM_R)).toEqual([0.2, -0.3, 0.4]);
    expect(at(mirrored, HAND_R)).toEqual([0, 0, 0]);
  });

  it('the rest of the partner’s hierarchy keeps its pose', () => {
    const bent = documentIn(setDofs.run(still, { ...NOW, dofs: turn(HAND_R, [0.5, 0, 0]) }));
    const pose = poseOf(documentIn(mirroredSetDofs.run(bent, { ...NOW, dofs: turn(ARM_L, [0, 0, 1]) })));
    expect(at(pose, HAND_R)).toEqual([0.5, 0, 0]);
    expect(at(pose, HAND_L)).toEqual([0, 0, 0]);
    expect(at(pose, ARM_R)).toEqual([0, 0, -1]);
  });

  it('joints in the middle are not mirrored, nor those of which both sides are set', () => {
    const middle = poseOf(documentIn(mirroredSetDofs.run(still, { ...NOW, dofs: turn(BODY, [0, 0.7, 0]) })));
    expect(middle.filter((value) => value !== 0)).toEqual([0.7]);
    const both = [...turn(ARM_L, [0.1, 0, 0]), ...turn(ARM_R, [0.9, 0, 0])];
    const pose = poseOf(documentIn(mirroredSetDofs.run(still, { ...NOW, dofs: both })));
    expect([pose[ARM_L], pose[ARM_R]]).toEqual([0.1, 0.9]);
  });

  it('auto-key keys the partner, too', () => {
    const take = { ...takeOfValues('walk', Array<number>(DOFS).fill(0)) };
    const keyed = documentIn(
      mirroredSetDofs.run(documentOf({ ...hero, takes: [take], shownTake: 0 }), {
        ...NOW,
        timeSeconds: 0.5,
        dofs: turn(ARM_L, [0, 0, 1]).slice(2),
        key: {},
      }),
    );
    const counts = keyed.characters[0].takes[0].channels.map((channel) => keysOf(channel).times.length);
    expect(counts.flatMap((count, d) => (count > 1 ? [d] : []))).toEqual([ARM_L + 2, ARM_R + 2]);
  });

  it('a locked partner is left alone, and told', () => {
    const locked = documentIn(setLocked.run(still, { characterId: 'c1', dofs: [ARM_R + 2], locked: true }));
    const change = mirroredSetDofs.run(locked, { ...NOW, dofs: turn(ARM_L, [0.2, 0, 1]) });
    expect('document' in change && change.locked).toBe(1);
    expect(at(poseOf(documentIn(change)), ARM_R)).toEqual([0.2, 0, 0]);
  });
});

describe('a pose that is pasted flipped', () => {
  const values = Array<number>(DOFS).fill(0);
  const bent = values
    .with(ARM_L + 2, 1)
    .with(HAND_L, 0.5)
    .with(BODY + 1, 0.3);

  it('is on the other side; the whole of it is what mirroring gives', () => {
    const pose = poseByNames(hero, { name: 'bent', values: bent });
    const flipped = documentIn(expectEdit(still, pastePose, { ...NOW, pose, flipped: true }));
    const pasted = documentIn(pastePose.run(still, { ...NOW, pose }));
    const mirrored = documentIn(mirrorPose.run(pasted, { ...NOW, way: 'swap' }));
    expect(poseOf(flipped)).toEqual(poseOf(mirrored));
    expect(poseOf(flipped)[ARM_R + 2]).toBeCloseTo(-1, 12);
  });

  it('of some joints changes only their partners, and those in the middle', () => {
    const whole = poseByNames(hero, { name: 'bent', values: bent });
    const { root: _root, ...joints } = whole;
    const pose = {
      ...joints,
      joints: joints.joints.map((one, j) => (j === 1 ? one : { ...one, dofs: [] })),
      weights: [],
    };
    const flipped = poseOf(documentIn(expectEdit(still, pastePose, { ...NOW, pose, flipped: true })));
    expect(flipped).toEqual(values.with(ARM_R + 2, -1));
  });
});
