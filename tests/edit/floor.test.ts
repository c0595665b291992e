import { expect, it } from 'vitest';
import { floorOf } from '../../src/edit/floor.ts';
import { DEFAULT_PLACEMENT } from '../../src/model/document.ts';
import type { Skeleton } from '../../src/model/skeleton/skeleton.ts';
import { channel, character, skeleton, take } from '../ui/builders.ts';

/** One joint whose box goes from `low` to `high`. */
function box(low: number, high: number): Skeleton {
  const made = skeleton(['body', -1]);
  const [body] = made.joints;
  return { ...made, joints: [{ ...body, offset: [0, 0, 0], box: { min: [-0.1, low, -0.1], max: [0.1, high, 0.1] } }] };
}

const of = (low: number, high: number, id = 'c1') => character({ id, skeleton: box(low, high), skins: [], takes: [] });

it('the floor is at the lowest point of a character whose origin is in its middle', () => {
  expect(floorOf([of(-1, 1)])).toBeCloseTo(-1, 9);
  expect(floorOf([of(-0.25, 1)])).toBeCloseTo(-0.25, 9);
});

it('the floor stays at 0 under what stands on it, or sinks in by no more than a tenth', () => {
  expect(floorOf([])).toBe(0);
  expect(floorOf([of(0, 2)])).toBe(0);
  expect(floorOf([of(0.5, 2)])).toBe(0);
  expect(floorOf([of(-0.1, 1)])).toBe(0);
});

it('the floor of several is at the lowest, unless one of them stands at 0', () => {
  expect(floorOf([of(-1, 1), of(-2, 2, 'c2')])).toBeCloseTo(-2, 9);
  expect(floorOf([of(-1, 1), of(0, 2, 'c2')])).toBe(0);
});

it('the floor counts characters as placed, and not as posed', () => {
  const placed = { ...of(-1, 1), placements: [{ ...DEFAULT_PLACEMENT, position: [0, 3, 0] as const, scale: 2 }] };
  // Raised, so that nothing of it is below 0.
  expect(floorOf([placed])).toBe(0);
  const posed = { ...of(-1, 1), pose: [0, -7, 0, 0, 0, 0] };
  expect(floorOf([posed])).toBeCloseTo(-1, 9);
});

it('a take that begins on the floor keeps it at 0', () => {
  const up = { ...channel(0), values: Float64Array.of(1) };
  const rest = { ...channel(0), values: Float64Array.of(0) };
  const walk = take([0, 1], rest, up, rest, rest, rest, rest);
  expect(floorOf([{ ...of(-1, 1), takes: [walk], shownTake: 0 }])).toBe(0);
});
