import fc from 'fast-check';
import { expect, it } from 'vitest';
import { Report } from '../../../src/formats/report.ts';
import { NumberPool } from '../../../src/import/fbx/records/number-pool.ts';
import { readFbxFile } from '../../../src/import/fbx/records/read-file.ts';
import { Texts } from '../../../src/import/fbx/records/texts.ts';
import { anyText } from '../../helpers/any-text.ts';
import { rec, recordBytes, type Value } from './write-fbx.ts';

const recordsOf = (bytes: Uint8Array<ArrayBuffer>) => readFbxFile(bytes, new Report('a.fbx')).file.records;

it('binary files have every value as it was written, in both orders of bytes and both widths', () => {
  const value: fc.Arbitrary<Value> = fc.oneof(
    fc.double(),
    fc.bigInt({ min: -(2n ** 63n), max: 2n ** 63n - 1n }),
    fc.bigInt({ min: -(2n ** 53n) - 2n, max: 2n ** 53n + 2n }),
    anyText().map((text) => new TextDecoder().decode(new TextEncoder().encode(text))),
    fc.float64Array({ maxLength: 40 }).map((values) => values.slice()),
    fc.float32Array({ maxLength: 40 }).map((values) => values.slice()),
    fc.int32Array({ maxLength: 40 }).map((values) => values.slice()),
  );
  fc.assert(
    fc.property(
      fc.array(value, { maxLength: 70 }),
      fc.boolean(),
      fc.constantFrom(7400, 7500),
      (values, isLittle, version) => {
        const [record] = recordsOf(recordBytes(version, [rec('Numbers', values, [rec('Inside', values)])], isLittle));
        const expected = values.map((own) =>
          typeof own === 'bigint' && Number.isSafeInteger(Number(own)) ? Number(own) : own,
        );
        expect(record.values).toEqual(expected);
        expect(record.children[0].values).toEqual(expected);
      },
    ),
    { numRuns: 200 },
  );
});

it('numbers of texts are those of JavaScript, integers of 64 bits exact', () => {
  const digits = fc.bigInt({ min: -(2n ** 63n), max: 2n ** 63n - 1n });
  const word = fc.oneof(
    fc.double({ noNaN: true, noDefaultInfinity: true }).map((number) => `${number}`),
    fc.double({ noNaN: true, noDefaultInfinity: true }).map((number) => number.toExponential()),
    fc.nat().map((number) => `+${number}.`),
    fc.nat().map((number) => `.${number}`),
    digits.map((number) => `${number}`),
    fc.constantFrom('-0', '0000000000000000000007', '1e999', '-1.#IND', '1.#INF', 'nan', '-inf', 'e5', '+', '.'),
  );
  fc.assert(
    fc.property(fc.array(word, { minLength: 1, maxLength: 20 }), (words) => {
      const text = `; FBX 7.4.0 project file\nNumbers: ${words.join(', ')}\n`;
      const [{ values }] = recordsOf(new TextEncoder().encode(text));
      const expected = words.map((own) => {
        if (/^-?\d{16,20}$/.test(own) && !Number.isSafeInteger(Number(own))) return BigInt(own);
        if (/#|nan|inf/.test(own)) return 0;
        return Number.isNaN(Number(own)) ? own : Number(own);
      });
      expect(values).toEqual(expected);
    }),
    { numRuns: 200 },
  );
});

it('a text is decoded once, and is never taken for another one', () => {
  const texts = fc.array(anyText({ maxLength: 3 }), { minLength: 1, maxLength: 3000 });
  fc.assert(
    fc.property(texts, (words) => {
      const parts = words.map((word) => new TextEncoder().encode(word));
      const bytes = Uint8Array.from(parts.flatMap((part) => [...part]));
      const texts = new Texts(bytes);
      let at = 0;
      for (const part of parts) {
        expect(texts.of(at, at + part.length)).toBe(new TextDecoder().decode(part));
        at += part.length;
      }
    }),
    { numRuns: 20 },
  );
});

it('short lists share buffers and are apart from each other; long ones have their own', () => {
  const pool = new NumberPool();
  const lists = Array.from({ length: 3000 }, (_, i) =>
    i % 3 === 0 ? pool.doubles(i % 20) : i % 3 === 1 ? pool.floats(i % 20) : pool.integers(i % 20),
  );
  expect(lists.every((list) => list.every((number) => number === 0))).toBe(true);
  for (const [i, list] of lists.entries()) list.fill(i);
  expect(lists.every((list, i) => list.every((number) => number === i))).toBe(true);
  expect(new Set(lists.map(({ buffer }) => buffer)).size).toBeLessThan(10);
  expect(pool.doubles(1000).buffer.byteLength).toBe(8000);
});
