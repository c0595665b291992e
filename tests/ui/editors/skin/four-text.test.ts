import { expect, it } from 'vitest';
import { oneSurface, type Skin } from '../../../../src/model/skin.ts';
import { attachmentsText, heatScale, scaleText } from '../../../../src/ui/editors/skin/four-text.ts';

const skin: Skin = {
  name: 'arm',
  positions: new Float64Array(3 * 1200),
  triangles: new Uint32Array(0),
  surfaces: oneSurface(new Uint32Array(0)),
  bindings: new Float64Array(16),
  attachments: { start: new Uint32Array(1201), joints: new Uint32Array(0), weights: new Float64Array(0) },
};
const counts = { beyondFour: 0, mostAttachments: 4, unevenSums: 0 };

it('a heat map of displacements ends at the next 1, 2 or 5', () => {
  expect(
    [0.0099, 0.01, 0.011, 0.02, 0.021, 0.05, 0.051, 0.7].map(heatScale).map((s) => Number(s.toPrecision(12))),
  ).toEqual([0.01, 0.01, 0.02, 0.02, 0.05, 0.05, 0.1, 1]);
});

it('a heat map of displacements has no scale for rounding and for what is no number', () => {
  expect([0, 1e-6, Number.NaN, Number.POSITIVE_INFINITY].map(heatScale)).toEqual([0, 0, 0, 0]);
});

it('the scale of displacements is told in percent of the size, also where it is tiny', () => {
  expect([0.02, 0.5, 2e-5, 0].map(scaleText)).toEqual([
    '2 % of size',
    '50 % of size',
    '0.002 % of size',
    'no displacement',
  ]);
});

it('a skin says how many vertices have more than four attachments', () => {
  expect(attachmentsText(skin, true, { ...counts, beyondFour: 1100, mostAttachments: 9 })).toBe(
    '1,100 of 1,200 vertices have more than four attachments, up to 9.',
  );
});

it('a skin of at most four attachments is drawn the same, unless normalising changes sums', () => {
  expect(attachmentsText(skin, true, counts)).toBe(
    'No vertex of arm has more than four attachments. A program that keeps four draws the same.',
  );
  expect(attachmentsText(skin, true, { ...counts, unevenSums: 1 })).toBe(
    'No vertex of arm has more than four attachments. 1 vertex has weights that don’t sum to 1, so normalising moves it.',
  );
});

it('a skin that nothing moves, or that follows the root, says so', () => {
  expect(attachmentsText(skin, false, counts)).toBe('arm has no skeleton, so nothing moves its vertices.');
  const { attachments: _, ...loose } = skin;
  expect(attachmentsText(loose, true, counts)).toBe('arm has no weights: all of it follows the root.');
});
