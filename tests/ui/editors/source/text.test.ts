import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { mapSource } from '../../../../src/formats/source/map-source.ts';
import { findLine } from '../../../../src/ui/editors/source/find-text.ts';
import { LineText, MAX_SHOWN } from '../../../../src/ui/editors/source/line-text.ts';

const indexOf = (text: string) => mapSource(new TextEncoder().encode(text), 'a.txt').index;
const never = new AbortController().signal;

/** A line, waiting until it is read. */
async function line(text: string, number: number) {
  let read = () => {};
  const waits = new Promise<void>((resolve) => {
    read = resolve;
  });
  const lines = new LineText(new Blob([text]), indexOf(text), read, (error) => expect(error).toBeUndefined());
  if (lines.get(number)) return lines.get(number);
  await waits;
  return lines.get(number);
}

describe('the text of a line', () => {
  it('is what the file has there, whatever ends its lines', async () => {
    const word = fc.constantFrom('a', 'bb', 'é', '\n', '\r', '\r\n', '\r\r\n', 'x'.repeat(300));
    await fc.assert(
      fc.asyncProperty(fc.array(word, { maxLength: 900 }), fc.nat(), async (words, pick) => {
        const text = words.join('');
        const all = text.split(/\r*\n|\r/);
        const number = 1 + (pick % all.length);
        expect((await line(text, number))?.text).toBe(all[number - 1].slice(0, MAX_SHOWN));
      }),
      { numRuns: 40 },
    );
  });

  it('is cut if it is very long, and the line after it is whole', async () => {
    const text = `${'1 '.repeat(400_000)}\nend`;
    expect(await line(text, 1)).toEqual({ text: '1 '.repeat(MAX_SHOWN / 2), more: 798_001, isAbout: true });
    expect(await line(text, 2)).toEqual({ text: 'end', more: 0, isAbout: false });
  });

  it('tells how many characters are left out', async () => {
    const text = `${'é'.repeat(MAX_SHOWN + 7)}\r\n${'é'.repeat(MAX_SHOWN)}`;
    expect(await line(text, 1)).toEqual({ text: 'é'.repeat(MAX_SHOWN), more: 7, isAbout: false });
    expect(await line(text, 2)).toEqual({ text: 'é'.repeat(MAX_SHOWN), more: 0, isAbout: false });
  });
});

describe('search in a file', () => {
  const text = ['one', 'Two two', 'three', 'one é'].join('\r\n');
  const find = (wanted: string, after: number) => findLine(new Blob([text]), indexOf(text), wanted, after, never);

  it('finds the next line in either case, and goes on at the start', async () => {
    expect(await find('one', 0)).toBe(1);
    expect(await find('ONE', 1)).toBe(4);
    expect(await find('two', 2)).toBe(2);
    expect(await find('é', 1)).toBe(4);
    expect(await find('one', 4)).toBe(1);
  });

  it('finds nothing where nothing is', async () => {
    expect(await find('four', 1)).toBeUndefined();
    expect(await find('', 1)).toBeUndefined();
  });

  it('finds what lies across the pieces in which it is read', async () => {
    const padding = 'x'.repeat((1 << 21) - 3);
    const long = `a\n${padding}needle\nb`;
    expect(await findLine(new Blob([long]), indexOf(long), 'needle', 0, never)).toBe(2);
  });
});
