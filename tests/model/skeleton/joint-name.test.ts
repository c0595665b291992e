import { expect, it } from 'vitest';
import { jointName, shortJointName } from '../../../src/model/skeleton/joint-name.ts';
import { joint, skeleton } from '../../helpers/builders.ts';

it('is the file’s, else says which joint it is, whether it is there or not', () => {
  const made = { ...skeleton(), joints: [joint(-1, { name: 'hips' }), joint(0, { name: '' })] };
  expect([0, 1, 2].map((index) => jointName(made, index))).toEqual(['hips', 'joint 1', 'joint 2']);
  expect(jointName(undefined, 0)).toBe('joint 0');
});

it('leaves out of a joint’s short name what all names begin with, up to a colon', () => {
  const short = (...names: readonly string[]) => {
    const made = { ...skeleton(), joints: names.map((name, j) => joint(j - 1, { name })) };
    return names.map((_, index) => shortJointName(made, index));
  };
  expect(short('mixamorig:Hips', 'mixamorig:Spine', 'tail')).toEqual(['Hips', 'Spine', 'tail']);
  expect(short('hero:rig:hips', 'hero:rig:spine', '', 'hero:rig:')).toEqual(['hips', 'spine', 'joint 2', 'hero:rig:']);
  expect(short('a:hips', 'b:hips')).toEqual(['a:hips', 'b:hips']);
  expect(short('only:one', 'hips')).toEqual(['only:one', 'hips']);
  expect(short('hips', 'spine')).toEqual(['hips', 'spine']);
});
