/** Takes with layers that no file has brought: the entries know them from the start. */
import { expect, it } from 'vitest';
import { arranged } from '../../src/model/takes/layers.ts';
import { takeArrays } from '../../src/package/dataset.ts';
import { poseAt } from '../../src/package/evaluate.ts';
import { writeGlb } from '../../src/package/export.ts';
import { character, skeleton, takeOfValues } from '../helpers/builders.ts';

it('poses, arrays and GLB of a take have its layers', () => {
  const base = takeOfValues('walk', new Array(9).fill(1));
  const layer = {
    name: 'arm',
    mode: 'additive',
    weight: 0.5,
    mute: false,
    solo: false,
    root: false,
    morphs: false,
  } as const;
  const motion = takeOfValues('arm', new Array(9).fill(0.2));
  const take = arranged(base, base, [{ ...layer, motion }], -1);
  const hero = character({ skeleton: skeleton(2), takes: [take], shownTake: 0, clampsToLimits: false });
  expect([...poseAt(hero, 0)]).toEqual(new Array(9).fill(1.1));
  expect(takeArrays(hero).frameCount).toBeGreaterThan(0);
  expect(writeGlb(hero).bytes.length).toBeGreaterThan(0);
});
