import { expect, it } from 'vitest';
import { jointName } from '../../src/model/joint-name.ts';
import { joint, skeleton } from '../helpers/builders.ts';

it('is the file’s, else says which joint it is, whether it is there or not', () => {
  const made = { ...skeleton(), joints: [joint(-1, { name: 'hips' }), joint(0, { name: '' })] };
  expect([0, 1, 2].map((index) => jointName(made, index))).toEqual(['hips', 'joint 1', 'joint 2']);
  expect(jointName(undefined, 0)).toBe('joint 0');
});
