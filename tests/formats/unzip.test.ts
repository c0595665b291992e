import { strFromU8, strToU8, zipSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { unzip } from '../../src/formats/unzip.ts';

const all = () => true;

/** Sets a field of every entry, in the central directory and at the entry itself. */
function altered(zip: Uint8Array, set: (view: DataView, inDirectory: number, inEntry: number) => void): Uint8Array {
  const bytes = zip.slice();
  const view = new DataView(bytes.buffer);
  for (let at = 0; at + 46 < bytes.length; at++) {
    if (view.getUint32(at, true) === 0x02014b50) set(view, at, view.getUint32(at + 42, true));
  }
  return bytes;
}

describe('zips', () => {
  it.each([0, 6] as const)('each entry has a buffer of its own and nothing else in it, at level %d', (level) => {
    const texts = { 'a.skel': 'balljoint a { }', 'b.skel': 'balljoint b { }'.repeat(99), 'c.skel': '' };
    const packed = Object.fromEntries(Object.entries(texts).map(([name, text]) => [name, strToU8(text)]));
    const { entries } = unzip(zipSync(packed, { level }), all);
    expect(entries.map(({ path, bytes }) => [path, strFromU8(bytes)])).toEqual(Object.entries(texts));
    expect(entries.map(({ bytes }) => bytes.buffer.byteLength)).toEqual(entries.map(({ bytes }) => bytes.length));
    expect(new Set(entries.map(({ bytes }) => bytes.buffer)).size).toBe(3);
  });

  it('an encrypted entry is refused by name, not unpacked to noise', () => {
    const zip = altered(zipSync({ 'a.skel': strToU8('balljoint a { }') }), (view, directory, entry) => {
      view.setUint16(directory + 8, view.getUint16(directory + 8, true) | 1, true);
      view.setUint16(entry + 6, view.getUint16(entry + 6, true) | 1, true);
    });
    expect(() => unzip(zip, all)).toThrow('a.skel is encrypted');
    expect(unzip(zip, () => false).passedOver).toEqual(['a.skel']);
  });

  it('an encrypted entry is refused in a zip with 64-bit records too', () => {
    const zip = altered(zipSync({ 'a.skel': strToU8('balljoint a { }') }), (view, directory, entry) => {
      view.setUint16(directory + 8, view.getUint16(directory + 8, true) | 1, true);
      view.setUint16(entry + 6, view.getUint16(entry + 6, true) | 1, true);
    });
    const end = zip.length - 22;
    const wide = new Uint8Array(zip.length + 76);
    wide.set(zip.subarray(0, end));
    wide.set(zip.subarray(end), end + 76);
    const [from, view] = [new DataView(zip.buffer), new DataView(wide.buffer)];
    view.setUint32(end, 0x06064b50, true);
    view.setBigUint64(end + 32, 1n, true);
    view.setBigUint64(end + 48, BigInt(from.getUint32(end + 16, true)), true);
    view.setUint32(end + 56, 0x07064b50, true);
    view.setBigUint64(end + 64, BigInt(end), true);
    view.setUint16(end + 76 + 10, 0xffff, true);
    view.setUint32(end + 76 + 16, 0xffffffff, true);
    expect(() => unzip(wide, all)).toThrow('a.skel is encrypted');
    expect(unzip(wide, () => false).passedOver).toEqual(['a.skel']);
  });

  it('an entry that states more than its bytes can hold is refused before anything is allocated for it', () => {
    const zip = altered(zipSync({ 'a.skel': strToU8('balljoint a { }') }), (view, directory, entry) => {
      view.setUint32(directory + 24, 2_000_000_000, true);
      view.setUint32(entry + 22, 2_000_000_000, true);
    });
    expect(() => unzip(zip, all)).toThrow('a.skel states 2000000000 bytes, more than its');
  });

  it('a bomb of entries that share one piece of data is refused', () => {
    const names = Object.fromEntries(Array.from({ length: 50 }, (_, i) => [`${i}.skel`, strToU8(`${i}`.repeat(9000))]));
    const stored = zipSync(names, { level: 0 });
    let first: number | undefined;
    const zip = altered(stored, (view, directory, entry) => {
      first ??= entry;
      view.setUint32(directory + 42, first, true);
      view.setUint32(directory + 20, 18_000, true);
      view.setUint32(directory + 24, 18_000, true);
    });
    expect(() => unzip(zip, all)).toThrow('its entries overlap');
  });

  it('much of little is refused above the limit, and a well-packed file below it is not', () => {
    const zip = zipSync({ 'a.bvh': new Uint8Array(3_000_000), 'b.bvh': new Uint8Array(3_000_000) });
    expect(() => unzip(zip, all, 5_000_000)).toThrow('more than 5000000 bytes');
    expect(unzip(zip, all).entries.map(({ bytes }) => bytes.length)).toEqual([3_000_000, 3_000_000]);
  });

  it('a zip in a zip stays one file, and paths that lead out of it are only names', () => {
    const inner = zipSync({ 'a.skel': strToU8('balljoint a { }') });
    const zip = zipSync({ 'inner.zip': inner, '../../b.skel': strToU8('b'), '/etc/c.skel': strToU8('c') });
    const { entries, passedOver } = unzip(zip, (path) => path.endsWith('.skel'));
    expect(entries.map(({ path, bytes }) => [path, strFromU8(bytes)])).toEqual([
      ['../../b.skel', 'b'],
      ['/etc/c.skel', 'c'],
    ]);
    expect(passedOver).toEqual(['inner.zip']);
  });

  it('names of prototypes are names', () => {
    const { entries } = unzip(zipSync({ 'constructor.skel': strToU8('a'), 'x/__proto__': strToU8('b') }), all);
    expect(entries.map(({ path }) => path)).toEqual(['constructor.skel', 'x/__proto__']);
  });
});
