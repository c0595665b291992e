import { describe, expect, it } from 'vitest';
import { changedDofs } from '../../../src/edit/hold/changed-dofs.ts';
import type { HeldFrames } from '../../../src/edit/hold/frames.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../helpers/builders.ts';

/** A hip, a shoulder that turns by a quaternion, and an elbow whose x follows its y. 3 + 3 + 4 + 3 DOFs. */
const ARM: Skeleton = {
  name: 'arm',
  joints: [
    joint(-1, { name: 'hip' }),
    joint(0, { name: 'shoulder', motion: { kind: 'quaternion' }, limits: [], pose: [0, 0, 0, 1] }),
    joint(1, { name: 'elbow', couples: [{ dof: 'rx', joint: 2, follows: 'ry', gain: 1, offset: 0 }] }),
  ],
};
const WIDTH = 13;

/** Two frames, the second of them with these DOFs changed by so much. */
function frames(changes: Readonly<Record<number, number>>): HeldFrames {
  const own = new Float64Array(2 * WIDTH);
  const held = own.slice();
  for (const [dof, by] of Object.entries(changes)) held[WIDTH + Number(dof)] += by;
  return { width: WIDTH, own, held, isReached: new Uint8Array(2).fill(1) };
}

describe('the DOFs that a hold has changed', () => {
  it('the DOFs that a hold has changed are all four components of a quaternion if one of them is', () => {
    for (const part of [6, 7, 8, 9]) expect(changedDofs(ARM, frames({ [part]: 0.1 }), 1)).toEqual([6, 7, 8, 9]);
    expect(changedDofs(ARM, frames({ 4: 0.1 }), 1)).toEqual([4]);
  });

  it('a hold counts visible changes of DOFs, lengths relative to the reach, but no linked DOFs', () => {
    expect(changedDofs(ARM, frames({ 0: 1e-6, 3: 1e-8, 10: 0.5, 11: 0.5 }), 1)).toEqual([0, 11]);
    expect(changedDofs(ARM, frames({ 0: 1e-6 }), 100)).toEqual([]);
  });
});
