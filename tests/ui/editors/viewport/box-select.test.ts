import { expect, it } from 'vitest';
import { jointsInBox, type SeenJoint } from '../../../../src/ui/editors/viewport/box-select.ts';

const seen: readonly SeenJoint[] = [
  { characterId: 'a', joint: 0, x: 10, y: 10 },
  { characterId: 'a', joint: 1, x: 20, y: 20 },
  { characterId: 'b', joint: 0, x: 12, y: 12 },
  { characterId: 'b', joint: 3, x: 90, y: 90 },
];
const at = (clientX: number, clientY: number) => ({ clientX, clientY });

it('a box selects the joints inside, whichever corner it began at', () => {
  const all = seen.slice(0, 3);
  expect(jointsInBox(seen, at(5, 5), at(25, 25), 'b')).toEqual(all);
  expect(jointsInBox(seen, at(25, 5), at(5, 25), 'b')).toEqual(all);
  expect(jointsInBox(seen, at(20, 20), at(15, 30), 'a')).toEqual([seen[1]]);
});

it('a box selects joints of all characters, those of the current one last, so that it stays active', () => {
  expect(jointsInBox(seen, at(0, 0), at(99, 99), 'b')).toEqual(seen);
  expect(jointsInBox(seen, at(0, 0), at(99, 99), 'a')).toEqual([seen[2], seen[3], seen[0], seen[1]]);
  expect(jointsInBox(seen, at(80, 80), at(99, 99), 'a')).toEqual([seen[3]]);
});

it('a box without joints selects nothing', () => {
  expect(jointsInBox(seen, at(30, 30), at(60, 60), 'a')).toEqual([]);
});
