import { describe, expect, it } from 'vitest';
import { jointHandles } from '../../../src/evaluate/handles/joint-handles.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { characterDofs } from '../../../src/model/skeleton/dofs.ts';
import type { Joint } from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../helpers/builders.ts';

/** Twice as large, and away from the origin. */
const PLACED = Float64Array.of(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, -3, 1, 1);

function sizeOf(joints: readonly Joint[], angle = 0): number {
  const skeleton = { name: 'rig', joints };
  const dofs = new Float64Array(characterDofs(skeleton, []).length).fill(angle, 3);
  const world = new Float64Array(16 * joints.length);
  worldMatrices(compileSkeleton(skeleton), dofs, world);
  return jointHandles(skeleton, 0, dofs, world, PLACED).size;
}

describe('the size of a joint’s handles', () => {
  it('the size of a joint’s handles is that of its longest bone in the world, in every pose', () => {
    const joints = [joint(-1), joint(0, { offset: [0, 0.5, 0] }), joint(0, { offset: [0, 0, -3] })];
    for (const angle of [0, 0.4, -2]) expect(sizeOf(joints, angle)).toBeCloseTo(6, 12);
  });

  it('the size of a last joint’s handles is that of its End Site, or of its box', () => {
    expect(sizeOf([joint(-1, { endSites: [[0, 1.5, 0]] })])).toBeCloseTo(3, 12);
    expect(sizeOf([joint(-1, { box: { min: [-0.1, 0, -0.1], max: [0.1, 2, 0.1] } })])).toBeCloseTo(4, 12);
    expect(sizeOf([joint(-1, { box: { min: [-1, -0.2, -0.1], max: [1, 0.2, 0.1] } })])).toBeCloseTo(2, 12);
  });

  it('the size of a joint’s handles takes no default box for a bone', () => {
    expect(sizeOf([joint(-1), joint(0, { offset: [0, 0.01, 0] })])).toBeCloseTo(0.02, 12);
    expect(sizeOf([joint(-1)])).toBeGreaterThan(0.1);
  });
});
