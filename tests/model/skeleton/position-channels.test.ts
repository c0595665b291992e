import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import {
  poseForPositions,
  positionsMeant,
  positionsTaken,
  withPositions,
} from '../../../src/model/skeleton/position-channels.ts';
import { skeleton } from '../../helpers/builders.ts';
import { personSkeleton, takeOfRoots } from '../../helpers/mocap.ts';

describe('what position channels mean', () => {
  const everywhere = personSkeleton({ positionsEverywhere: true });

  it('what position channels mean is to replace OFFSETs where they repeat them', () => {
    expect(positionsMeant(everywhere, takeOfRoots(everywhere, [[0, 90, 0]]))).toBe('replace');
  });

  it('what position channels mean is to be added to OFFSETs where they stay at 0', () => {
    expect(positionsMeant(everywhere, takeOfRoots(everywhere, [[0, 90, 0]], 0))).toBe('add');
  });

  it('says a root alone nothing about: it moves the character', () => {
    const plain = personSkeleton();
    expect(positionsMeant(plain, takeOfRoots(plain, [[0, 0, 0]]))).toBe('replace');
    expect(positionsMeant(everywhere, undefined)).toBe('replace');
  });
});

describe('another meaning of position channels', () => {
  const before = personSkeleton({ positionsEverywhere: true });

  it('another meaning of position channels keeps rest pose and set pose in place', () => {
    const pose = filePose(before, 0).map((value, dof) => value + dof / 100);
    const after = withPositions(before, 'add');
    expect(positionsTaken(after)).toBe('add');
    for (const [was, is] of [
      [filePose(before, 0), filePose(after, 0)],
      [pose, poseForPositions(before, pose, 'add')],
    ]) {
      const expected = new Float64Array(16 * before.joints.length);
      const found = new Float64Array(16 * before.joints.length);
      worldMatrices(compileSkeleton(before), Float64Array.from(was), expected);
      worldMatrices(compileSkeleton(after), Float64Array.from(is), found);
      found.forEach((value, i) => {
        expect(value).toBeCloseTo(expected[i], 9);
      });
    }
  });

  it('another meaning of position channels comes back to what it was', () => {
    const back = withPositions(withPositions(before, 'add'), 'replace');
    expect(back.joints.map((j) => j.motion)).toEqual(before.joints.map((j) => j.motion));
    expect(withPositions(before, 'replace')).toBe(before);
  });

  it('another meaning of position channels is nothing to a skeleton without such channels', () => {
    const plain = skeleton();
    expect(positionsTaken(plain)).toBeUndefined();
    expect(withPositions(plain, 'add')).toBe(plain);
  });
});
