import { Vector3 } from 'three';
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
