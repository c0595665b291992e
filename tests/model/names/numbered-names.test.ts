import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { freeName } from '../../../src/edit/rig/names.ts';
import { lastDigitsIn, trailingDigitsAt } from '../../../src/model/names/numbered-names.ts';
import { restOfLine } from '../../../src/model/names/written-names.ts';

const names = fc.string({ unit: fc.constantFrom('1', '20', 'a', ' ', '_', '\t', '٣'), maxLength: 12 });

describe('digits in names', () => {
  it('the last digits of a name are those that a regular expression finds', () => {
    fc.assert(
      fc.property(names, (name) => {
        expect(lastDigitsIn(name)).toBe(/(\d+)\D*$/.exec(name)?.[1]);
        expect(trailingDigitsAt(name, 99)).toBe(name.search(/\d*$/));
        expect(name.length - trailingDigitsAt(name, 2)).toBe(/\d{0,2}$/.exec(name)?.[0].length);
      }),
    );
  });

  it('the next free name counts on, keeps leading zeros, and ends for numbers of any length', () => {
    expect(freeName(new Set(['spine1', 'spine2']), 'spine1')).toBe('spine3');
    expect(freeName(new Set(['a09']), 'a09')).toBe('a10');
    expect(freeName(new Set(['hip']), 'hip')).toBe('hip_2');
    const long = `a${'9'.repeat(20)}`;
    const taken = new Set([long, `a1${'0'.repeat(20)}`, freeName(new Set([long]), long)]);
    const next = freeName(taken, long);
    expect(taken.has(next)).toBe(false);
    expect(next).toMatch(/^a\d+$/);
  });

  it('blanks at the ends of a name that is the rest of a line become underscores, those inside stay', () => {
    fc.assert(
      fc.property(names, (name) => {
        const blanks = (text: string) => '_'.repeat(text.length);
        expect(restOfLine(name)).toBe(name.replace(/^[ \t]+|[ \t]+$/g, blanks));
      }),
    );
  });
});
