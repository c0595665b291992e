import { expect, it } from 'vitest';
import type { Space } from '../../../../src/model/space.ts';
import {
  columnText,
  distanceNumber,
  distanceText,
  distanceUnit,
} from '../../../../src/ui/editors/takes/distance-text.ts';
import { character } from '../../../helpers/builders.ts';

const inUnit = (unit: Space['unit']) => character({ space: { up: 'y', unit, lift: 0 } });

it('distances of captures are in centimetres or metres, in the texts and in the heads of their columns', () => {
  const near = distanceUnit(inUnit('inches'), inUnit('cmu'), 0.847);
  expect([distanceText(0.847, near), distanceNumber(0.847, near), columnText('Mean', near)]).toEqual([
    '84.7 cm',
    '84.7',
    'Mean (cm)',
  ]);
  const far = distanceUnit(inUnit('inches'), inUnit('cmu'), 2.53);
  expect([distanceText(2.53, far), columnText('Max', far)]).toEqual(['2.53 m', 'Max (m)']);
});

it('distances of characters without a known unit are plain numbers', () => {
  const plain = distanceUnit(inUnit('asIs'), inUnit('cmu'), 3);
  expect([distanceText(3, plain), columnText('Mean', plain)]).toEqual(['3', 'Mean']);
  expect(distanceUnit(character(), inUnit('metres'), 3)).toEqual(plain);
});
