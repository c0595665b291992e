import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { typedUnits } from '../../../../src/ui/state/joints/angles.ts';
import {
  aligned,
  bytes,
  count,
  decimalsWithin,
  duration,
  errorSize,
  exact,
  notANumber,
  parseNumber,
  plural,
  shown,
} from '../../../../src/ui/widgets/numbers/number-text.ts';

describe('exact', () => {
  it('exact reads back the same', () => {
    fc.assert(
      fc.property(fc.double({ noNaN: true, noDefaultInfinity: true }), (value) => {
        expect(parseNumber(exact(value))).toBe(value === 0 ? 0 : value);
      }),
    );
  });
});

it('says how long something lasts as lists have room for', () => {
  expect([22.924908, 2, 0.5, 0].map(duration)).toEqual(['22.92 s', '2 s', '0.5 s', '0 s']);
});

describe('shown', () => {
  it.each([
    [0, '0'],
    [-0, '0'],
    [1.5, '1.5'],
    [1.23456, '1.235'],
    [-2.5, '−2.5'],
    [0.0004, '0'],
    [-0.0004, '0'],
    [0.0006, '0.001'],
    [1234567890, '1.23e+9'],
    [-1234567890, '−1.23e+9'],
    [123456789, '123456789'],
    [100, '100'],
    [Number.NaN, 'NaN'],
    [-Infinity, '−∞'],
  ])('writes %d as %s', (value, text) => {
    expect(shown(value)).toBe(text);
  });

  it('shown keeps the zeros of whole numbers', () => {
    expect(shown(1200, 0)).toBe('1200');
  });

  it('shown never has more than three decimals, a hyphen or a minus zero, and reads back as nearly the same', () => {
    fc.assert(
      fc.property(fc.double({ min: -1e6, max: 1e6, noNaN: true }), (value) => {
        const text = shown(value);
        expect(text).toMatch(/^(0|−?\d+(\.\d{1,3})?)$/);
        expect(text).not.toBe('−0');
        expect(Math.abs((parseNumber(text) ?? Number.NaN) - value)).toBeLessThanOrEqual(0.000501);
      }),
    );
  });
});

it('lines numbers up', () => {
  expect([0.5, -1, 1e-9, -1e-9].map((v) => aligned(v))).toEqual(['0.500', '−1.000', '0.000', '0.000']);
  expect([Infinity, -Infinity, Number.NaN].map((v) => aligned(v))).toEqual(['∞', '−∞', 'NaN']);
});

it('tells a small error from none', () => {
  expect([0, 1e-9, 0.0004, 0.0006, 1.23456].map(errorSize)).toEqual([
    '0',
    'under 0.001',
    'under 0.001',
    '0.001',
    '1.235',
  ]);
});

describe('parseNumber', () => {
  it.each([
    ['1.5', 1.5],
    [' 1,5 ', 1.5],
    ['−2', -2],
    ['+.5', 0.5],
    ['1e-3', 1e-3],
    ['2.', 2],
    ['20+5', 25],
    ['20 - 5 - 5', 10],
    ['-3/4', -0.75],
    ['2 * (1 − 0,5) + 1', 2],
    ['10/4/2', 1.25],
    ['2*-3', -6],
    ['3 × 4 ÷ 6', 2],
    ['1e2+1e-2', 100.01],
    ['pi/2', Math.PI / 2],
    ['-(2)', -2],
  ])('parseNumber reads %s', (text, value) => {
    expect(parseNumber(text)).toBe(value);
  });

  it.each([
    '',
    '-',
    'x',
    '1x',
    '1.2.3',
    '0x10',
    'Infinity',
    '1e999',
    '12°3',
    '12 x',
    '20+',
    '(1',
    '1)',
    '2(3)',
    '1 2',
    '1//2',
    '--1',
    '1/0',
    '0/0',
    '1+x',
    'e',
    '1e',
    '()',
    '45°',
    'constructor',
  ])('parseNumber takes %s for no number', (text) => {
    expect(parseNumber(text)).toBeUndefined();
  });
});

describe('a typed change of a number', () => {
  it.each([
    ['+=5', 17],
    ['-=5', 7],
    ['−= 2+1', 9],
    ['*2', 24],
    [' *= 0.5', 6],
    ['/4', 3],
    ['÷=3', 4],
    ['×1,5', 18],
    ['+5', 5],
    ['-5', -5],
  ])('%s of 12 is %s', (text, value) => {
    expect(parseNumber(text, {}, 12)).toBe(value);
  });

  it('a typed change has no noise of binary fractions', () => {
    expect(parseNumber('+=0.2', {}, 0.1)).toBe(0.3);
  });

  it('a typed change needs a number to change, an amount and a finite result', () => {
    expect(parseNumber('+=5')).toBeUndefined();
    expect(parseNumber('*2', {}, Number.NaN)).toBeUndefined();
    for (const text of ['+=', '*', '/=', '/0', '+=x', '**2', '=5']) expect(parseNumber(text, {}, 1)).toBeUndefined();
  });

  it('a typed change takes units for what is added, and none for a factor', () => {
    const units = typedUnits('angle', 'degrees');
    expect(parseNumber('+=1 rad', units, 0)).toBeCloseTo(180 / Math.PI, 9);
    expect(parseNumber('*2°', units, 1)).toBeUndefined();
  });
});

it('takes no text that is longer than a person types', () => {
  expect(parseNumber('('.repeat(1e6))).toBeUndefined();
});

describe('units', () => {
  const inDegrees = typedUnits('angle', 'degrees');
  const inRadians = typedUnits('angle', 'radians');

  it.each([
    ['45°', 45],
    ['45 deg', 45],
    ['1 rad', 180 / Math.PI],
    ['20+0.5rad', 20 + (0.5 * 180) / Math.PI],
    ['(10+20)°/2', 15],
    ['pi rad', 180],
    ['30 DEG', 30],
  ])('reads %s where degrees are shown', (text, value) => {
    expect(parseNumber(text, inDegrees)).toBeCloseTo(value, 12);
  });

  it('reads degrees where radians are shown', () => {
    expect(parseNumber('180°', inRadians)).toBeCloseTo(Math.PI, 14);
    expect(parseNumber('0.5rad', inRadians)).toBe(0.5);
  });

  it.each(['12 x', '12 degr', '° 12', '12°°', '12 m', 'rad'])('units takes %s for no angle', (text) => {
    expect(parseNumber(text, inDegrees)).toBeUndefined();
  });

  it('units are none where no angle is shown', () => {
    expect(parseNumber('45°', typedUnits('length', 'degrees'))).toBeUndefined();
  });
});

it('counts', () => {
  expect(count(1234567)).toBe('1,234,567');
  expect(plural(1, 'vertex', 'vertices')).toBe('1 vertex');
  expect(plural(2, 'vertex', 'vertices')).toBe('2 vertices');
  expect([12, 1, 3400, 52e6, 999_600, 5e12].map(bytes)).toEqual([
    '12 bytes',
    '1 byte',
    '3.4 kB',
    '52 MB',
    '1.0 MB',
    '5000 GB',
  ]);
});

it.each([
  [-118.3412, '−118.341'],
  [0.123456, '0.123'],
  [-12345.678, '−12345.7'],
  [1234567.89, '1234568'],
  [90, '90'],
])('writes %d in eight characters as %s', (value, text) => {
  expect(shown(value, decimalsWithin(value, 8))).toBe(text);
});

it('says what of a typed text is no number, cut to what a line holds', () => {
  expect(notANumber('Frame', ' ten ')).toBe('Frame: “ten” is not a number.');
  expect(notANumber('Frame', 'x'.repeat(30))).toBe(`Frame: “${'x'.repeat(24)}…” is not a number.`);
});
