import { expect, it } from 'vitest';
import { boneEnds } from '../../../src/model/skeleton/bone-ends.ts';
import { hasAllBoxes, hasBox } from '../../../src/model/skeleton/boxes.ts';
import { joint } from '../../helpers/builders.ts';

it('a bone ends at its End Sites, and at its tip if there is no child', () => {
  const joints = [
    joint(-1, { offset: [0, 0, 0], length: 2 }),
    joint(0, { offset: [0, 2, 0], length: 3 }),
    joint(1, {
      offset: [1, 3, 0],
      length: 0,
      endSites: [
        [0, 0, 0],
        [1, 0, 0],
      ],
    }),
    joint(2, { offset: [0, 0, 0], length: 1 }),
  ];
  expect(boneEnds({ name: 'x', joints })).toEqual([
    { joint: 1, at: [0, 3, 0] },
    { joint: 2, at: [1, 0, 0] },
    { joint: 3, at: [0, 1, 0] },
  ]);
});

it('a joint with a bone of its own has a box only where one is set', () => {
  const bone = joint(-1, { length: 1 });
  const boxed = { ...bone, box: { min: [0, 0, 0], max: [0.1, 0.1, 0.2] } as const };
  expect([bone, boxed, joint(-1)].map(hasBox)).toEqual([false, true, true]);
  expect(hasAllBoxes({ name: 'x', joints: [boxed, bone] })).toBe(false);
});
