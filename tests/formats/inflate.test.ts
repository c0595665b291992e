/** Unpacking deflated data, against zlib: whole data, its beginning, and what is no such data. */
import { deflateRawSync, inflateRawSync } from 'node:zlib';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { inflate } from '../../src/formats/inflate.ts';

/** Bytes that deflate packs in different ways: noise, few symbols, repeats near and far. */
const contents = fc.oneof(
  fc.uint8Array({ maxLength: 3000 }),
  fc.array(fc.constantFrom(0, 1, 7, 255), { maxLength: 3000 }).map((list) => Uint8Array.from(list)),
  fc
    .tuple(fc.uint8Array({ minLength: 1, maxLength: 300 }), fc.integer({ min: 1, max: 400 }))
    .map(([part, times]) => Uint8Array.from({ length: part.length * times }, (_, i) => part[i % part.length])),
);
const options = fc.record({
  level: fc.integer({ min: 0, max: 9 }),
  strategy: fc.integer({ min: 0, max: 4 }),
  memLevel: fc.integer({ min: 1, max: 9 }),
});
const packed = fc
  .tuple(contents, options)
  .map(([bytes, how]) => ({ bytes, data: new Uint8Array(deflateRawSync(bytes, how)) }));

describe('deflated data', () => {
  it('is unpacked as zlib packed it, in any way', () => {
    fc.assert(
      fc.property(packed, ({ bytes, data }) => {
        const out = new Uint8Array(bytes.length);
        expect(inflate(data, out)).toEqual({ ending: 'whole', length: bytes.length });
        expect(Buffer.compare(out, bytes)).toBe(0);
      }),
    );
  });

  it('is unpacked up to where there is no more room, and then there is more', () => {
    fc.assert(
      fc.property(packed, fc.nat(5000), ({ bytes, data }, n) => {
        if (bytes.length === 0) return;
        const room = n % bytes.length;
        const out = new Uint8Array(room);
        expect(inflate(data, out)).toEqual({ ending: 'more', length: room });
        expect(Buffer.compare(out, bytes.subarray(0, room))).toBe(0);
      }),
    );
  });

  it('that is cut off never seems whole', () => {
    fc.assert(
      fc.property(packed, fc.nat(5000), ({ bytes, data }, n) => {
        const cut = data.subarray(0, n % data.length);
        expect(inflate(cut, new Uint8Array(bytes.length + 1)).ending).not.toBe('whole');
      }),
    );
  });

  it('that is damaged unpacks to what zlib makes of it, or is told', () => {
    const changes = fc.array(fc.tuple(fc.nat(400), fc.nat(255)), { minLength: 1, maxLength: 3 });
    fc.assert(
      fc.property(packed, changes, ({ data }, list) => {
        const damaged = data.slice();
        for (const [at, byte] of list) damaged[at % damaged.length] = byte;
        const wanted = unpackedByZlib(damaged);
        const out = new Uint8Array(wanted?.length ?? 200_000);
        const { ending, length } = inflate(damaged, out);
        if (!wanted) return;
        expect({ ending, length }).toEqual({ ending: 'whole', length: wanted.length });
        expect(Buffer.compare(out, wanted)).toBe(0);
      }),
      { numRuns: 300 },
    );
  });

  it('in blocks of bytes as they are ends where their lengths say', () => {
    // The last block, of three bytes; its length, and that with all bits turned.
    const data = Uint8Array.of(1, 3, 0, 0xfc, 0xff, 7, 8, 9, 99);
    const out = new Uint8Array(3);
    expect(inflate(data, out)).toEqual({ ending: 'whole', length: 3 });
    expect([...out]).toEqual([7, 8, 9]);
    expect(inflate(data.subarray(0, 7), new Uint8Array(3)).ending).toBe('cut');
    expect(inflate(Uint8Array.of(1, 3, 0, 0, 0, 7, 8, 9), out).ending).toBe('damaged');
    // A kind of block that there isn't.
    expect(inflate(Uint8Array.of(7, 0, 0, 0), out).ending).toBe('damaged');
  });
});

function unpackedByZlib(data: Uint8Array): Buffer | undefined {
  try {
    return inflateRawSync(data, { maxOutputLength: 200_000 });
  } catch {
    return undefined;
  }
}
