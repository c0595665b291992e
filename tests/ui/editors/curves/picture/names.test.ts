import fc from 'fast-check';
import { expect, it } from 'vitest';
import { movedApart } from '../../../../../src/ui/editors/curves/picture/names.ts';

it('names of curves are where these end, and moved apart where they are close', () => {
  expect(movedApart([20, 80, 160], 200)).toEqual([20, 80, 160]);
  expect(movedApart([50, 52, 54], 200)).toEqual([50, 65, 80]);
});

it('names stay in the plot, in their order, apart by a line, as long as there is room', () => {
  fc.assert(
    fc.property(fc.array(fc.double({ min: -500, max: 500, noNaN: true }), { maxLength: 12 }), (any) => {
      const places = movedApart(
        any.toSorted((a, b) => a - b),
        200,
      );
      for (const [i, place] of places.entries()) {
        expect(place).toBeGreaterThanOrEqual(7.5);
        expect(place).toBeLessThanOrEqual(192.5);
        if (i > 0) expect(place - places[i - 1]).toBeGreaterThanOrEqual(15 - 1e-9);
      }
    }),
  );
});
