import { describe, expect, it } from 'vitest';
import { documentIn } from '../../../src/edit/change.ts';
import { CommandError } from '../../../src/edit/command-error.ts';
import { setClamping, setDofs } from '../../../src/edit/commands/pose.ts';
import {
  applyPose,
  keepPose,
  mirrorPose,
  pastePose,
  removePoses,
  renamePose,
  updatePose,
} from '../../../src/edit/commands/poses.ts';
import { blendPoses } from '../../../src/edit/pose/blend.ts';
import { poseByNames } from '../../../src/edit/pose/by-names.ts';
import { Store } from '../../../src/edit/store.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { type Document, findCharacter } from '../../../src/model/document.ts';
import { EULER_ORDERS, type Joint } from '../../../src/model/skeleton/skeleton.ts';
import { keysOf } from '../../../src/model/takes/take.ts';
import { character, documentOf, joint, morph, takeOfValues } from '../../helpers/builders.ts';

/** Blended angles have passed through a quaternion. */
const TURNED = 1e-12;

const joints: readonly Joint[] = [
  joint(-1, { name: 'hip' }),
  joint(0, { name: 'arm_l', offset: [1, 0, 0] }),
  joint(1, { name: 'hand_l', offset: [1, 0, 0] }),
  joint(0, { name: 'arm_r', offset: [-1, 0, 0] }),
  joint(3, { name: 'hand_r', offset: [-1, 0, 0] }),
];
const skeleton = { name: 'hero', joints };
const morphs = [morph('smile_L'), morph('smile_R'), morph('jaw')];
const pose = [1, 2, 3, 0, 0, 0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0, 0, 0, 0, 0, 0, 0.7, 0.1, 0.2];
const still = documentOf(character({ skeleton, morphs, pose }));
const shown = (document: Document, timeSeconds = 0) => {
  const found = document.characters[0];
  const out = new Float64Array(dofCountOf(found));
  poseAt(found, timeSeconds, out);
  return [...out];
};
const at = { characterId: 'c1', timeSeconds: 0 };

describe('poses.mirror', () => {
  it('mirrors the whole character in place: its joints, and morphs of two sides', () => {
    const next = documentIn(mirrorPose.run(still, { ...at, way: 'swap' }));
    expect(shown(next)).toEqual([1, 2, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.1, -0.2, -0.3, 0.4, -0.5, -0.6, 0.1, 0.7, 0.2]);
    expect(shown(documentIn(mirrorPose.run(next, { ...at, way: 'swap' })))).toEqual(pose);
  });

  it('copies one side onto the other, and refuses if there is none', () => {
    const next = documentIn(mirrorPose.run(still, { ...at, joint: 1, way: 'toOther' }));
    expect(shown(next).slice(6, 18)).toEqual([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.1, -0.2, -0.3, 0.4, -0.5, -0.6]);
    expect(() => mirrorPose.run(still, { ...at, joint: 0, way: 'toOther' })).toThrow('hip is in the middle');
    expect(() => mirrorPose.run(still, { ...at, way: 'toOther' })).toThrow(CommandError);
    expect(() => mirrorPose.run(still, { ...at, joint: 9, way: 'swap' })).toThrow(CommandError);
    const lone = documentOf(character({ skeleton: { name: 's', joints: [joint(-1), joint(0, { name: 'l_arm' })] } }));
    expect(() => mirrorPose.run(lone, { ...at, joint: 1, way: 'toOther' })).toThrow('no counterpart');
  });

  it('returns the same document if the pose is its own mirror image', () => {
    const symmetric = documentOf(character({ skeleton }));
    expect(documentIn(mirrorPose.run(symmetric, { ...at, way: 'swap' }))).toBe(symmetric);
  });

  it('poses.mirror is unkeyed over keys, and keyed with auto-key', () => {
    const keyed = documentOf(character({ skeleton, pose, takes: [takeOfValues('walk', pose)], shownTake: 0 }));
    const next = documentIn(mirrorPose.run(keyed, { ...at, way: 'swap' }));
    expect(next.characters[0].unkeyed?.dofs.length).toBeGreaterThan(0);
    expect(next.characters[0].takes).toBe(keyed.characters[0].takes);
    // What is the same on both sides was not touched.
    expect(next.characters[0].unkeyed?.dofs).not.toContain(1);
    const auto = documentIn(mirrorPose.run(keyed, { ...at, timeSeconds: 0.5, way: 'swap', key: {} }));
    expect(auto.characters[0].unkeyed).toBeUndefined();
    expect(auto.characters[0].takes[0].channels.slice(0, 18).every((c) => keysOf(c).times.includes(0.5))).toBe(true);
    expect(shown(auto, 0.5).slice(12, 15)).toEqual([0.1, -0.2, -0.3]);
  });
});

describe('the library’s commands', () => {
  const kept = keepPose.run(still, { characterId: 'c1', timeSeconds: 0 });

  it('the library’s commands keep the pose shown, under names of its own', () => {
    expect(kept.characters[0].poses).toEqual([{ name: 'pose 1', values: pose }]);
    const more = keepPose.run(kept, { characterId: 'c1', timeSeconds: 0, name: 'pose 1' });
    expect(more.characters[0].poses?.map(({ name }) => name)).toEqual(['pose 1', 'pose 2']);
  });

  it('rename and remove', () => {
    const sit = renamePose.run(kept, { characterId: 'c1', pose: 0, name: ' sit ' });
    expect(sit.characters[0].poses?.[0].name).toBe('sit');
    expect(renamePose.run(sit, { characterId: 'c1', pose: 0, name: 'sit' })).toBe(sit);
    const two = keepPose.run(sit, { characterId: 'c1', timeSeconds: 0 });
    expect(() => renamePose.run(two, { characterId: 'c1', pose: 1, name: 'sit' })).toThrow('already');
    expect(() => renamePose.run(two, { characterId: 'c1', pose: 1, name: ' ' })).toThrow(CommandError);
    expect(removePoses.run(two, { characterId: 'c1', poses: [1] }).characters[0].poses).toHaveLength(1);
    expect('poses' in removePoses.run(sit, { characterId: 'c1', poses: [0] }).characters[0]).toBe(false);
    expect(() => removePoses.run(sit, { characterId: 'c1', poses: [3] })).toThrow(CommandError);
  });

  it('apply a pose exactly, in part, or below one joint, within limits', () => {
    const zero = documentIn(setDofs.run(kept, { ...at, dofs: pose.map((_, index) => ({ index, value: 0 })) }));
    expect(shown(documentIn(applyPose.run(zero, { ...at, pose: 0 })))).toEqual(pose);
    const branch = shown(documentIn(applyPose.run(zero, { ...at, pose: 0, joints: [1] })));
    expect(branch).toEqual(pose.map((v, d) => (d >= 6 && d < 12 ? v : 0)));
    const each = [0, 1, 2].map((joint) => shown(documentIn(applyPose.run(zero, { ...at, pose: 0, joints: [joint] }))));
    const both = shown(documentIn(applyPose.run(zero, { ...at, pose: 0, joints: [2, 1] })));
    expect(both).toEqual(pose.map((_, d) => each[1][d] || each[2][d]));
    const half = shown(documentIn(applyPose.run(zero, { ...at, pose: 0, share: 0.5 })));
    expect([half[0], half[18]]).toEqual([0.5, 0.35]);
    expect(documentIn(applyPose.run(zero, { ...at, pose: 0, share: 0 }))).toBe(zero);
    expect(() => applyPose.run(zero, { ...at, pose: 0, share: 2 })).toThrow('from 0 to 1');
    expect(() => applyPose.run(zero, { ...at, pose: 1 })).toThrow(CommandError);
    const limited = joints.map((j) => ({ ...j, limits: j.limits.map(() => ({ min: -0.2, max: 0.2 })) }));
    const tight = { ...kept, characters: [{ ...kept.characters[0], skeleton: { name: 'h', joints: limited } }] };
    const within = { ...tight, characters: [{ ...tight.characters[0], pose: pose.map(() => 0) }] };
    expect(Math.max(...documentIn(applyPose.run(within, { ...at, pose: 0 })).characters[0].pose.slice(3, 18))).toBe(
      0.2,
    );
    const free = setClamping.run(tight, { characterId: 'c1', clamps: false });
    expect(shown(documentIn(applyPose.run(free, { ...at, pose: 0 })))).toEqual(pose);
  });

  it('a saved pose that is updated keeps its name and place, and is the displayed pose', () => {
    const store = new Store(still);
    store.apply(keepPose, { characterId: 'c1', timeSeconds: 0, name: 'first' });
    store.apply(keepPose, { characterId: 'c1', timeSeconds: 0, name: 'second' });
    const before = store.document;
    // It is the same still: no step.
    store.apply(updatePose, { characterId: 'c1', pose: 0, timeSeconds: 0 });
    expect(store.document).toBe(before);
    store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 6, value: 0.75 }], timeSeconds: 0 });
    store.apply(updatePose, { characterId: 'c1', pose: 0, timeSeconds: 0 });
    const [first, second] = store.document.characters[0].poses ?? [];
    expect([first.name, first.values]).toEqual(['first', shown(store.document)]);
    expect(second).toBe(before.characters[0].poses?.[1]);
    expect(store.undoLabel).toBe('Update first in pose library');
    expect(() => updatePose.run(store.document, { characterId: 'c1', pose: 2, timeSeconds: 0 })).toThrow(CommandError);
  });

  it('the library’s commands are undone in one step each', () => {
    const store = new Store(still);
    store.apply(keepPose, { characterId: 'c1', timeSeconds: 0 });
    store.apply(applyPose, { ...at, pose: 0, joints: [1], share: 0.5 });
    store.apply(mirrorPose, { ...at, way: 'swap' });
    store.apply(removePoses, { characterId: 'c1', poses: [0] });
    expect(store.undoLabel).toBe('Remove pose 1');
    while (store.undo());
    expect(findCharacter(store.document, 'c1')).toEqual(still.characters[0]);
  });
});

describe('poses.paste', () => {
  it('sets what fits and leaves the rest', () => {
    const copied = poseByNames({ skeleton, morphs }, { name: 'a', values: pose });
    const other = documentOf(
      character({ skeleton: { name: 'o', joints: [joint(-1, { name: 'hand_l' }), joint(0, { name: 'x' })] } }),
    );
    const next = shown(documentIn(pastePose.run(other, { ...at, pose: copied })));
    expect(next).toEqual([1, 2, 3, 0.4, 0.5, 0.6, 0, 0, 0]);
  });

  it('refuses anything but a pose, whoever calls', () => {
    const bad = (value: unknown) => () => pastePose.run(still, { ...at, pose: value as never });
    expect(bad(3)).toThrow(CommandError);
    expect(bad({ name: 'a', joints: [{ name: 'hip', dofs: [{ name: 'rx', value: Number.NaN }] }] })).toThrow(
      CommandError,
    );
    expect(bad({ name: 'a', root: [1], joints: [] })).toThrow(CommandError);
    expect(bad({ name: 'a', joints: [], weights: [] })).toThrow('none of the joints');
  });
});

describe('a blend', () => {
  it.each(EULER_ORDERS)('a blend turns a ball of order %s along the shortest arc, at an even pace', (order) => {
    const ball = { name: 'b', joints: [joint(-1, { motion: { kind: 'ball', order } })] };
    const [from, to] = [
      [0, 0, 0, 2.9, 0.3, -2.8],
      [0, 0, 0, -2.9, -0.4, 2.7],
    ];
    const turnOf = (dofs: readonly number[]) => {
      const world = new Float64Array(16);
      worldMatrices(compileSkeleton(ball), Float64Array.from(dofs), world);
      return world;
    };
    const angle = (a: Float64Array, b: Float64Array) => {
      let trace = 0;
      for (const k of [0, 1, 2, 4, 5, 6, 8, 9, 10]) trace += a[k] * b[k];
      return Math.acos(Math.min(1, (trace - 1) / 2));
    };
    const whole = angle(turnOf(from), turnOf(to));
    for (const share of [0.25, 0.5, 0.75]) {
      const between = turnOf(blendPoses(ball, from, to, share));
      expect(Math.abs(angle(turnOf(from), between) - share * whole)).toBeLessThan(1e-6);
      expect(Math.abs(angle(between, turnOf(to)) - (1 - share) * whole)).toBeLessThan(1e-6);
    }
  });

  it('a blend keeps a quaternion on its way, and ends exactly', () => {
    const free = { name: 'q', joints: [joint(-1, { motion: { kind: 'quaternion' }, pose: [0, 0, 0, 1] })] };
    const from = [0, 0, 0, 0, 0, 0, 1];
    const to = [2, 0, 0, -Math.SQRT1_2, 0, 0, -Math.SQRT1_2];
    const half = blendPoses(free, from, to, 0.5);
    expect(half[0]).toBe(1);
    // −q is the same turn, and the nearer one.
    expect(Math.abs(half[3] - Math.sin(Math.PI / 8))).toBeLessThan(TURNED);
    expect(Math.abs(half[6] - Math.cos(Math.PI / 8))).toBeLessThan(TURNED);
    expect(blendPoses(free, from, to, 1)).toEqual(to);
    expect(blendPoses(free, from, to, 0)).toEqual(from);
  });
});
