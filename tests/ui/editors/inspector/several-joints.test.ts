/** The field of a DOF that several joints have. */
import { expect, it } from 'vitest';
import { typedValues } from '../../../../src/ui/editors/inspector/dof-rows.ts';

const DEGREES = 180 / Math.PI;
const from = [0, 0.1, 0.2, 0.4];
const values = (text: string, typedFrom = from[1] * DEGREES) =>
  typedValues({ text, from: typedFrom }, from, { index: 1 }, [2, 3], DEGREES, { decimals: 2 }).map(
    ({ index, value }) => [index, Number((value * DEGREES).toPrecision(10))],
  );
const degrees = (radians: number) => Number((radians * DEGREES).toPrecision(10));

it('a number typed for several joints sets all', () => {
  expect(values('30')).toEqual([
    [2, 30],
    [3, 30],
  ]);
});

it('+=5 and *2 typed for several joints change each from its own value', () => {
  expect(values('+=5')).toEqual([
    [2, degrees(0.2 + 5 / DEGREES)],
    [3, degrees(0.4 + 5 / DEGREES)],
  ]);
  expect(values('*2')).toEqual([
    [2, degrees(0.4)],
    [3, degrees(0.8)],
  ]);
});

it('+=5 typed after arrow keys counts from where these led all of the joints', () => {
  expect(values('+=5', from[1] * DEGREES + 10)).toEqual([
    [2, degrees(0.2 + 15 / DEGREES)],
    [3, degrees(0.4 + 15 / DEGREES)],
  ]);
});

it('what is no number sets nothing', () => {
  expect(values('abc')).toEqual([]);
});

it('what is shown of a joint, typed for several, changes the others only', () => {
  const shownOfSecond = String(Number((0.2 * DEGREES).toFixed(2)));
  const [second, third] = typedValues(
    { text: shownOfSecond, from: from[1] * DEGREES },
    from,
    { index: 1 },
    [2, 3],
    DEGREES,
    { decimals: 2 },
  );
  expect(second.value).toBe(0.2);
  expect(third.value).not.toBe(0.4);
});
