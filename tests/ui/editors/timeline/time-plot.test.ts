import { expect, it } from 'vitest';
import { nearest, type Readable, valueTicks, valueY } from '../../../../src/ui/editors/timeline/time-plot.ts';

const axis = { height: 128, head: 18, foot: 10, least: -1, most: 4 };

it('an axis of values has its least at the foot, its most at the head, and is even between', () => {
  expect([-1, 1.5, 4].map((value) => valueY(axis, value))).toEqual([118, 68, 18]);
});

it('ticks are round, apart as labels need, and both ends of the axis are among them if they are round', () => {
  expect(valueTicks(axis)).toEqual([0, 2, 4]);
  expect(valueTicks({ ...axis, height: 28 + 5 * 28 })).toEqual([-1, 0, 1, 2, 3, 4]);
  expect(valueTicks({ ...axis, height: 0 })).toEqual([0]);
});

it('ticks of metres read as centimetres are round in centimetres', () => {
  const ticks = valueTicks({ ...axis, least: 0, most: 0.031 }, 100);
  expect(ticks.map((value) => value * 100)).toEqual([0, 1, 2, 3].map((cm) => expect.closeTo(cm, 12)));
});

it('the pointer reads the nearest value within its reach, and of two the first', () => {
  const at = (y: number, name: string): Readable => ({ timeSeconds: 0, y, text: () => name });
  const read = (y: number) => nearest([at(20, 'far'), at(40, 'first'), at(40, 'second'), at(43, 'near')], y)?.text();
  expect([39, 40, 41, 42].map(read)).toEqual(['first', 'first', 'first', 'near']);
  expect([57, 58, 6, 5].map(read)).toEqual(['near', undefined, 'far', undefined]);
  expect(nearest([at(Number.NaN, 'none')], 0)).toBeUndefined();
});
