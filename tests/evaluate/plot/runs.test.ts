import fc from 'fast-check';
import { expect, it } from 'vitest';
import { PLAIN, SELECTED } from '../../../src/edit/keys/marks.ts';
import { runsOf } from '../../../src/evaluate/plot/runs.ts';

function drawn(marks: Uint8Array) {
  const diamonds: [number, number][] = [];
  const bands: [number, number, number][] = [];
  runsOf(marks, {
    diamond: (pixel, mark) => diamonds.push([pixel, mark]),
    band: (first, last, mark) => bands.push([first, last, mark]),
  });
  return { diamonds, bands };
}

it('draws keys apart as diamonds', () => {
  const marks = new Uint8Array(40);
  marks[3] = PLAIN;
  marks[20] = SELECTED;
  marks[21] = PLAIN | SELECTED;
  expect(drawn(marks)).toEqual({
    diamonds: [
      [3, PLAIN],
      [20, SELECTED],
      [21, PLAIN | SELECTED],
    ],
    bands: [],
  });
});

it('draws keys at every other pixel as a band, in pieces of one state', () => {
  const marks = new Uint8Array(60);
  for (let p = 10; p <= 40; p += 2) marks[p] = p < 20 ? PLAIN : SELECTED;
  expect(drawn(marks)).toEqual({
    diamonds: [],
    bands: [
      [10, 18, PLAIN],
      [20, 40, SELECTED],
    ],
  });
});

it('draws every marked pixel once, in its own state', () => {
  fc.assert(
    fc.property(fc.array(fc.constantFrom(0, 0, 0, PLAIN, SELECTED, PLAIN | SELECTED), { maxLength: 200 }), (list) => {
      const marks = Uint8Array.from(list);
      const { diamonds, bands } = drawn(marks);
      const times = new Uint8Array(marks.length);
      for (const [pixel, mark] of diamonds) {
        expect(mark).toBe(marks[pixel]);
        times[pixel]++;
      }
      for (const [first, last, mark] of bands) {
        expect([marks[first], marks[last]]).toEqual([mark, mark]);
        for (let p = first; p <= last; p++) {
          if (marks[p] === 0) continue;
          expect(marks[p]).toBe(mark);
          times[p]++;
        }
      }
      expect(times).toEqual(marks.map((m) => (m ? 1 : 0)));
    }),
  );
});
