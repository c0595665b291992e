import { expect, it } from 'vitest';
import { pinAxes, pinHandles } from '../../../src/evaluate/handles/pin-handles.ts';
import { cross, dot } from '../../../src/math/vec3.ts';

/** Two joints: the second turned a quarter about z, and twice as large. */
const WORLD = Float64Array.of(
  ...[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1],
  ...[0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 1, 0, 1],
);
const TURNED = Float64Array.of(0, 0, -3, 0, 0, 3, 0, 0, 3, 0, 0, 0, 0, 0, 0, 1);

it('a pin is moved along the character’s axes, its joint’s or those of the joint above, which for the root are the character’s', () => {
  const close = (axes: ReturnType<typeof pinAxes>) =>
    axes.map((axis) => axis.map((part) => Math.round(part * 1e9) / 1e9 + 0));
  const own = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  expect(close(pinAxes('world', 1, 0, WORLD))).toEqual(own);
  expect(close(pinAxes('parent', 1, 0, WORLD))).toEqual(own);
  expect(close(pinAxes('parent', 0, -1, WORLD))).toEqual(own);
  expect(close(pinAxes('local', 1, 0, WORLD))).toEqual([
    [0, 1, 0],
    [-1, 0, 0],
    [0, 0, 1],
  ]);
});

it('a pin has three arrows and three squares, and rings if it holds an orientation, in the scene and of unit length', () => {
  const axes = pinAxes('world', 0, -1, WORLD);
  const { handles, planes = [], pivot } = pinHandles([1, 2, 3], 0.5, axes, TURNED, true);
  expect(pivot).toEqual([1, 2, 3]);
  expect(handles.map(({ id, kind }) => [id.kind, kind])).toEqual([
    ...Array.from({ length: 3 }, () => ['own', 'turn']),
    ...Array.from({ length: 3 }, () => ['along', 'slide']),
  ]);
  expect(handles.map(({ axis }) => dot(axis, axis))).toEqual([1, 1, 1, 1, 1, 1]);
  expect(handles[3].axis).toEqual([0, 0, -1]);
  for (const {
    axes: [u, v],
    hue,
  } of planes) {
    // Across its plane is the axis whose colour it has.
    expect(Math.abs(dot(cross(u, v), handles[hue].axis))).toBeCloseTo(1, 12);
  }
  expect(pinHandles(pivot, 0.5, axes, TURNED, false).handles).toHaveLength(3);
});
