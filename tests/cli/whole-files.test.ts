/** Files read and written in one go. */
import { createHash } from 'node:crypto';
import { appendFileSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import fc from 'fast-check';
import { afterAll, expect, it } from 'vitest';
import { InputReader } from '../../src/cli/export/read-input.ts';
import { writeOutput } from '../../src/cli/write-output.ts';

const folder = mkdtempSync(join(tmpdir(), 'marrow-files-'));
const path = join(folder, 'file');
const bytesOf = (piece: string | Uint8Array) => (typeof piece === 'string' ? new TextEncoder().encode(piece) : piece);
afterAll(() => rmSync(folder, { recursive: true, force: true }));

it('pieces of texts and bytes are written one after the other, however many, and their bytes are counted', () => {
  const piece = fc.oneof(fc.string(), fc.uint8Array({ maxLength: 40 }));
  const lists = fc.oneof(fc.array(piece, { maxLength: 8 }), fc.array(piece, { minLength: 500, maxLength: 600 }));
  fc.assert(
    fc.property(lists, (pieces) => {
      const whole = Buffer.concat(pieces.map(bytesOf));
      expect(writeOutput(path, pieces)).toEqual({ bytes: whole.length });
      expect(readFileSync(path).equals(whole)).toBe(true);
    }),
    { numRuns: 20 },
  );
});

it('a file whose pieces fail is not written, and what was there stays', () => {
  writeFileSync(path, 'before');
  function* pieces() {
    yield 'half';
    throw new Error('no more');
  }
  expect(writeOutput(path, pieces())).toEqual({ failure: 'no more' });
  expect(readFileSync(path, 'utf8')).toBe('before');
  expect(readdirSync(folder)).toEqual(['file']);
});

it('inputs have the hash of their bytes, which are given unless they are too many', () => {
  const reader = new InputReader(100);
  for (const size of [90, 3, 0, 100, 101, 20]) {
    const bytes = Uint8Array.from({ length: size }, (_, i) => (7 * i) & 0xff);
    writeFileSync(path, bytes);
    const read = reader.read({ path, absolute: path });
    expect(read.hash).toBe(createHash('sha256').update(bytes).digest('hex'));
    expect(read.bytes && [...read.bytes]).toEqual(size > 100 ? undefined : [...bytes]);
  }
  appendFileSync(path, 'more');
  expect(reader.read({ path, absolute: path }).bytes).toHaveLength(24);
});
