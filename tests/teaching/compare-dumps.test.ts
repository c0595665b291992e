import { describe, expect, it } from 'vitest';
import { readDump } from '../../src/formats/dump/read.ts';
import type { Dump } from '../../src/model/dump.ts';
import { compareDumps } from '../../src/teaching/compare/compare-dumps.ts';

function dump(text: string): Dump {
  const { value } = readDump(new TextEncoder().encode(text), 'numbers.txt');
  if (!value) throw new Error('It holds no numbers.');
  return value;
}

const compared = (theirs: string, right: string, tolerance = 1e-4) =>
  compareDumps(dump(theirs), dump(right), tolerance);

describe('dumps compared number by number', () => {
  const points = '0 0 0\n3 4 0\n1 1 1\n';

  it('agree with themselves, whatever is in them', () => {
    for (const text of [points, '0.5 nan\n1 inf\n', 'channel 3\n0 1\n0.5 2\n', '1 2 3 4\n']) {
      expect(compared(text, text)).toEqual({ agrees: true, numbers: dump(text).blocks[0].values.length, worst: 0 });
    }
  });

  it('dumps compared number by number say the first line that is wrong, and what was expected', () => {
    expect(compared('0 0 0\n3 4 0\n1 1.5 2\n', points)).toMatchObject({
      agrees: false,
      first: 'line 3 has 1.5, expected 1',
    });
  });

  it('dumps compared number by number have errors of points over the size, others as they are', () => {
    expect(compared('0 0 0\n3 4.5 0\n1 1 1\n', points).worst).toBeCloseTo(0.5 / Math.hypot(3, 4, 1), 12);
    expect(compared('channel 3\n0 1\n0.5 2.5\n', 'channel 3\n0 1\n0.5 2\n').worst).toBe(0.5);
    expect(compared('0 0 0\n3 nan 0\n1 1 1\n', points).worst).toBe(Number.POSITIVE_INFINITY);
  });

  it('dumps compared number by number differ by how many numbers and lists they have', () => {
    expect(compared('0 0 0\n3 4 0\n', points).first).toBe('line 1 has 6 numbers, expected 9');
    expect(compared(points, `time 1\n${points}time 2\n${points}`).first).toBe('1 list of numbers, expected 2');
  });

  it('matrices of 12 numbers agree with the same of 16, by rows and by columns', () => {
    const rows = '0 -1 0 5\n1 0 0 6\n0 0 1 7\n';
    const whole = `${rows}0 0 0 1\n`;
    const columns = '0 1 0 0\n-1 0 0 0\n0 0 1 0\n5 6 7 1\n';
    for (const theirs of [rows, whole, columns]) expect(compared(theirs, whole).agrees).toBe(true);
    // 48 numbers could be four matrices of 12.
    expect(compared(columns.repeat(3), whole.repeat(3))).toMatchObject({ agrees: true, numbers: 48 });
    expect(compared(rows.repeat(4), whole.repeat(4)).agrees).toBe(true);
    expect(compared(columns.replace('5 6 7', '5 6 8'), whole).agrees).toBe(false);
  });
});
