/** Transforming an image to the next view: positions of its pixels in another view of the same curves. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type CurveSpace, pan, valueAt, yOf, zoom } from '../../../../../src/ui/editors/curves/scene/space.ts';
import { movedBetween } from '../../../../../src/ui/editors/curves/scene/view-change.ts';
import { timeAt, timeX } from '../../../../../src/ui/widgets/time/time-window.ts';
import { line, SPACE } from '../scenes.ts';

const number = (min: number, max: number) => fc.double({ min, max, noNaN: true });
const LINES = [line(0, 'angle'), line(1, 'length'), line(2, 'normalised')];
const SPREAD: CurveSpace = {
  ...SPACE,
  axes: { ...SPACE.axes, length: { low: -3, high: 250 }, normalised: { low: -1.15, high: 1.15 } },
};

describe('from one view of the curves to another', () => {
  it('maps each pixel to its time and value in the other view, on every axis', () => {
    const by = number(-300, 300);
    const factor = number(0.6, 1.6);
    fc.assert(
      fc.property(by, by, factor, factor, number(0, 400), number(0, 200), (dx, dy, ft, fv, x, y) => {
        const to = zoom(pan(SPREAD, dx, dy), 123, 77, ft, fv);
        const change = movedBetween(SPREAD, to, LINES);
        if (!change) throw new Error('there is such a change');
        expect(change.scaleX * x + change.x).toBeCloseTo(timeX(to, timeAt(SPREAD, x)), 3);
        for (const each of LINES) {
          expect(change.scaleY * y + change.y).toBeCloseTo(yOf(to, each, valueAt(SPREAD, each, y)), 3);
        }
      }),
    );
  });

  it('from one view of the curves to another is undefined once an axis was fitted separately, unless no line uses it', () => {
    const fitted = { ...SPREAD, axes: { ...SPREAD.axes, length: { low: 0, high: 100 } } };
    expect(movedBetween(SPREAD, fitted, LINES)).toBeUndefined();
    expect(movedBetween(SPREAD, fitted, [line(0, 'angle')])).toEqual({ scaleX: 1, scaleY: 1, x: 0, y: 0 });
  });

  it('from one view of the curves to another is undefined if the image would be scaled too much', () => {
    expect(movedBetween(SPREAD, zoom(SPREAD, 200, 100, 0.2, 1), LINES)).toBeUndefined();
    expect(movedBetween(SPREAD, zoom(SPREAD, 200, 100, 1, 5), LINES)).toBeUndefined();
  });
});
