/** Messages of the sample tools, and their units. */
import { describe, expect, it } from 'vitest';
import { cropped, split } from '../../../../src/edit/samples/frames.ts';
import { DEFAULT_SPACE } from '../../../../src/model/space.ts';
import { shownRate } from '../../../../src/ui/editors/curves/dialogs/sample-dialogs.ts';
import { cutText, splitText } from '../../../../src/ui/editors/timeline/sample-tools.ts';
import { lengthUnit } from '../../../../src/ui/state/joints/length-unit.ts';
import { swing, swinging } from '../../../edit/samples/made.ts';

const before = { character: swinging(), take: swing };

describe('the message line', () => {
  it('tells which take has how many frames after a split', () => {
    const [first, second] = split(swing, 1);
    const named = { ...second, name: 'swing_2' };
    const character = { ...swinging(), takes: [first, named], shownTake: 1 };
    expect(splitText({ character, take: named }, 0)).toBe('Split: swing has 60 frames, swing_2 has 61 frames.');
  });

  it('tells what a cut has left, in displayed seconds', () => {
    const character = { ...before.character, timeOffsetSeconds: 0.25 };
    const take = cropped(swing, 0.5, 1.5);
    expect(cutText('crop', before, { character, take })).toBe('Cropped swing to 61 of 121 frames, 0.25 – 1.25 s.');
    expect(cutText('trimEnd', before, { ...before, take })).toBe('Trimmed swing to 61 of 121 frames, 0.5 – 1.5 s.');
    expect(cutText('trimStart', before, before)).toBe('swing has no frames to cut there.');
  });
});

describe('numbers in the dialogs', () => {
  it('numbers in the dialogs have the unit of the character', () => {
    const units = (['asIs', 'centimetres', 'metres', 'inches', 'millimetres', 'own'] as const).map((unit) =>
      lengthUnit({ space: { ...DEFAULT_SPACE, unit } }),
    );
    expect(units).toEqual(['units', 'cm', 'm', 'in', 'mm', 'units']);
    expect(lengthUnit({})).toBe('units');
  });

  it.each([
    [1 / 0.016667, 60],
    [1 / 0.0083333, 120],
    [1 / 0.00833, 120],
    [1 / 0.033333, 30],
    [30000 / 1001, 29.97],
    [24000 / 1001, 23.976],
    [12.5, 12.5],
    [0.2, 0.2],
  ])('numbers in the dialogs are rates as one says them: %d is %d', (rate, shown) => {
    expect(shownRate(rate)).toBe(shown);
  });
});
