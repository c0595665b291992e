import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { keyedTake } from '../../../src/edit/convert/keys-of-samples.ts';
import { skelForm } from '../../../src/edit/convert/skel-form.ts';
import { animOf, bvhOf, skelOf } from '../../../src/files/save/character-files.ts';
import type { Capture } from '../../../src/model/files.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { keysOf } from '../../../src/model/takes/take.ts';
import { bvhJoint, captureOf } from '../../helpers/bvh.ts';
import { anyCapture } from './captures.ts';
import { characterOf, frameTimes, worstDistance } from './round-trip.ts';

/** `.skel` and `.anim` of a capture, as a character. */
function skelAndAnim(capture: Capture) {
  const skeleton = skelOf({ skeleton: capture.skeleton, pose: filePose(capture.skeleton, 0) });
  if (!skeleton || !capture.take) throw new Error('There is a skeleton and a take.');
  return characterOf({ skeleton, take: animOf(capture, capture.take) });
}

const angle = fc.double({ min: -400, max: 400, noNaN: true });

describe('BVH as .skel and .anim', () => {
  it('BVH as .skel and .anim makes of each joint the simplest type that moves as it does', () => {
    const joints = [
      bvhJoint(-1, ['tx', 'ty', 'tz', 'rz', 'rx', 'ry']),
      bvhJoint(0, ['rz', 'ry', 'rx']),
      bvhJoint(0, []),
      bvhJoint(0, ['ry', 'rz']),
      bvhJoint(0, ['rx', 'tz']),
    ];
    expect(skelForm({ name: 'x', joints }).skeleton.joints.map(({ motion }) => motion)).toEqual([
      { kind: 'free', order: 'yxz' },
      { kind: 'ball', order: 'xyz' },
      { kind: 'fixed' },
      { kind: 'compound', dofs: ['ry', 'rz'] },
      { kind: 'compound', dofs: ['tz', 'rx'] },
    ]);
  });

  it('BVH as .skel and .anim makes a leaf of each End Site, right behind its joint and before that joint’s children', () => {
    const joints = [
      bvhJoint(-1, ['rx'], { endSites: [[1, 2, 3]] }),
      bvhJoint(0, ['rx'], { name: 'tip', endSites: [[4, 5, 6]] }),
    ];
    const { skeleton } = skelForm({ name: 'x', joints });
    expect(skeleton.joints.map(({ name, parent, offset }) => [name, parent, offset])).toEqual([
      ['joint0', -1, [0, 1, 0]],
      ['End_Site', 0, [1, 2, 3]],
      ['tip', 0, [0, 1, 0]],
      ['End_Site', 2, [4, 5, 6]],
    ]);
    expect(skeleton.joints.every((joint) => joint.endSites === undefined)).toBe(true);
  });

  it('leaves a skeleton of .skel unchanged', () => {
    const { skeleton } = skelForm(captureOf({ name: 'x', joints: [bvhJoint(-1, ['rx'])] }, [[0]]).skeleton);
    expect(skelForm(skeleton).skeleton).toBe(skeleton);
  });

  it('moves every joint and End Site as before, at every frame, for channels of any kind', () => {
    fc.assert(
      fc.property(anyCapture(angle), (capture) => {
        const worst = worstDistance(characterOf(capture), skelAndAnim(capture), frameTimes(capture));
        expect(worst).toBeLessThan(1e-9);
      }),
    );
  });

  it('converts back to BVH with every joint and End Site in place', () => {
    fc.assert(
      fc.property(anyCapture(angle), (capture) => {
        const there = skelAndAnim(capture);
        const [{ capture: back }] = bvhOf(there, 1 / (capture.take?.samples?.frameSeconds ?? 1));
        expect(worstDistance(there, characterOf(back), frameTimes(back))).toBeLessThan(1e-7);
      }),
    );
  });

  it('gives keys that do not spin: an angle that jumps by a whole turn is unrolled', () => {
    const capture = captureOf({ name: 'x', joints: [bvhJoint(-1, ['rx'])] }, [[170], [-175], [-160]]);
    if (!capture.take) throw new Error('There is a take.');
    const { channels, samples } = keyedTake(capture.take, capture.skeleton);
    expect(samples).toBeUndefined();
    expect(Array.from(keysOf(channels[3]).values, (v) => Math.round((v * 180) / Math.PI))).toEqual([170, 185, 200]);
  });

  it('BVH as .skel and .anim keeps only the keys that a tolerance asks for', () => {
    const rows = Array.from({ length: 100 }, (_, f) => [10 * Math.sin(f / 20)]);
    const capture = captureOf({ name: 'x', joints: [bvhJoint(-1, ['rx'])] }, rows);
    if (!capture.take) throw new Error('There is a take.');
    const all = keyedTake(capture.take, capture.skeleton);
    const few = keyedTake(capture.take, capture.skeleton, { tolerance: 0.001 });
    expect(keysOf(all.channels[3]).times).toHaveLength(100);
    expect(keysOf(few.channels[3]).times.length).toBeLessThan(20);
  });
});
