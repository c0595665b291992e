/** Names have no bound in files: what is looked for in them is found in a time that grows with their length. */
import { it } from 'vitest';
import { partnersByName } from '../../src/edit/pose/sides.ts';
import { freeName, mirroredName } from '../../src/edit/rig/names.ts';
import { readName } from '../../src/evaluate/retarget/names.ts';
import { readDump } from '../../src/formats/dump/read.ts';
import { lastDigitsIn } from '../../src/model/names/numbered-names.ts';
import { restOfLine } from '../../src/model/names/written-names.ts';
import { expectLinearTime } from '../helpers/growth.ts';

const NAMES: Readonly<Record<string, (length: number) => string>> = {
  capitals: (n) => 'A'.repeat(n),
  'capitals and small letters in turn': (n) => 'Aa'.repeat(n / 2),
  'digits before a letter': (n) => `${'1'.repeat(n)}a`,
  'digits between letters': (n) => `${'1'.repeat(n)}a1`,
  'blanks between letters': (n) => `a${' '.repeat(n)}a`,
  'number signs on lines': (n) => '#\n'.repeat(n / 2),
  brackets: (n) => '('.repeat(n),
  'letters behind a bracket': (n) => `(${'a'.repeat(n)}`,
  'a number too long': (n) => `${'1'.repeat(n)}.x`,
};

it.each(Object.entries(NAMES))('a name of %s', (_, name) => {
  expectLinearTime((n) => {
    const long = name(n);
    readName(long);
    mirroredName(long);
    freeName(new Set([long]), long);
    partnersByName([long, `${long}L`]);
    lastDigitsIn(long);
    restOfLine(long);
    readDump(`${long}: 1 2 3\n${long}\n1 2 3\n[1, 2, ${long}]\n`, `x@${long}.txt`);
  }, 50_000);
});
