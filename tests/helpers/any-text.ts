/** Texts of any characters, for properties. */
import fc from 'fast-check';

/** Code points that are halves of others, and none by themselves. */
const HALVES = { from: 0xd800, count: 0x800 } as const;

/**
 * Any code point but those: the same as fast-check's unit `binary`, which makes a table of a million of them first, a
 * second in each process.
 */
const codePoint = fc.nat({ max: 0x10ffff - HALVES.count }).map(
  (at) => String.fromCodePoint(at < HALVES.from ? at : at + HALVES.count),
  (text) => {
    const [one, ...more] = typeof text === 'string' ? text : '';
    const at = one?.codePointAt(0);
    if (at === undefined || more.length > 0) throw new Error('No code point.');
    if (at < HALVES.from) return at;
    if (at < HALVES.from + HALVES.count) throw new Error('Half a code point.');
    return at - HALVES.count;
  },
);

/** Texts of any code points. */
export const anyText = (lengths: { readonly minLength?: number; readonly maxLength?: number } = {}) =>
  fc.string({ ...lengths, unit: codePoint });
