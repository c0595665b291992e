import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { filesInQuery } from '../../src/io/address.ts';

describe('files named in the address', () => {
  it('files named in the address are separated by commas', () => {
    expect(filesInQuery('?files=a.skel,b/c.skin')).toEqual(['a.skel', 'b/c.skin']);
  });

  it('files named in the address are none without the key', () => {
    expect(filesInQuery('')).toEqual([]);
    expect(filesInQuery('?file=a&files=')).toEqual([]);
  });

  it('files named in the address keep a percent sign that encodes nothing', () => {
    expect(filesInQuery('?files=100%.skel')).toEqual(['100%.skel']);
  });

  it('files named in the address come out as they went in when encoded, whatever is in their names', () => {
    const name = fc.string({ unit: 'grapheme', minLength: 1 });
    fc.assert(
      fc.property(fc.array(name, { minLength: 1 }), (names) => {
        expect(filesInQuery(`?theme=dark&files=${names.map(encodeURIComponent).join(',')}`)).toEqual(names);
      }),
    );
  });
});
