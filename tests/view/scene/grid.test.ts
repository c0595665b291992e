import { Mesh, Vector3 } from 'three';
import { expect, it } from 'vitest';
import { Grid } from '../../../src/view/scene/grid.ts';

it('the grid is drawn at any distance from the origin, where one line may be no other than the next', () => {
  const grid = new Grid();
  for (const x of [0, 1e6, 1e15, 1e20, 1e300]) {
    for (const unitsPerPixel of [1e-300, 1e-6, 0.01, 1e12]) {
      grid.update({ target: new Vector3(x, 0, -x), distance: 500 * unitsPerPixel, unitsPerPixel, plane: 'ground' });
      expect(grid.step, `${x}, ${unitsPerPixel}`).toBeGreaterThan(0);
    }
  }
});

it('labels of the grid fade with the distance from what is looked at, and are written anew only where others come into reach', () => {
  const grid = new Grid();
  const [, glyphs] = grid.object.children;
  const written = () => (glyphs instanceof Mesh ? glyphs.geometry.attributes.tint.version : Number.NaN);
  const look = (x: number) =>
    grid.update({ target: new Vector3(x, 0, 0), distance: 5, unitsPerPixel: 0.01, plane: 'ground' });
  look(0.5);
  const first = written();
  for (let i = 1; i <= 10; i++) look(0.5 + i / 1000);
  expect(written()).toBe(first);
  look(2.5);
  expect(written()).toBe(first + 1);
});
