import { expect, it } from 'vitest';
import { cutMessage } from '../../../src/model/names/cut-text.ts';

it.each(['word', 'name'])(
  'a message with a %s of a megabyte is cut as one with a shorter, its own words kept',
  (what) => {
    const message = (length: number) => {
      const long = `begin${'n'.repeat(length)}end`;
      return `Joint ${what === 'word' ? long : `"${long.replaceAll('nnnnn', 'nnnn ')}"`} has no parent.`;
    };
    const cut = cutMessage(message(1_000_000));
    expect(cut).toBe(cutMessage(message(3000)));
    expect(cut).toMatch(/^Joint "?begin.+….+end"? has no parent\.$/);
    expect(cut.length).toBeLessThan(250);
  },
);

it('a message of many short words is cut in its middle, and one that is short enough is the same', () => {
  const words = Array.from({ length: 200_000 }, (_, i) => `w${i}`).join(' ');
  expect(cutMessage(words)).toMatch(/^w0 w1 .+….+ w199998 w199999$/);
  expect(cutMessage(words)).toHaveLength(1000);
  expect(cutMessage('w '.repeat(400))).toBe('w '.repeat(400));
});
