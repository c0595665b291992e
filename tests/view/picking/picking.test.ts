import { describe, expect, it } from 'vitest';
import { heaviestJoint, trianglesEndingIn } from '../../../src/view/picking/picking.ts';
import { skin } from '../../helpers/builders.ts';

describe('picking a skin', () => {
  const attachments = {
    start: Uint32Array.of(0, 3, 3, 5),
    joints: Uint32Array.of(4, 2, 7, 1, 5),
    weights: Float64Array.of(0.2, 0.5, 0.3, 0.5, 0.5),
  };

  it('gives the joint with the largest weight on the vertex, the first of equal ones', () => {
    const held = skin('hero', 0, { attachments });
    expect(heaviestJoint(held, 0)).toBe(2);
    expect(heaviestJoint(held, 2)).toBe(1);
  });

  it('gives no joint for a vertex without attachments', () => {
    expect(heaviestJoint(skin('hero', 0, { attachments }), 1)).toBeUndefined();
  });

  it('finds the triangles whose id a pixel can have', () => {
    expect(trianglesEndingIn([0, 1, 2, 2, 1, 3, 3, 0, 2], 2)).toEqual([0, 6]);
    expect(trianglesEndingIn([], 2)).toEqual([]);
  });
});
