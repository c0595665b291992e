import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { FileContent } from '../../src/model/files.ts';
import { anyText } from '../helpers/any-text.ts';
import { expectEqual } from '../helpers/equal.ts';
import { writeFile } from '../helpers/write-file.ts';
import * as arbitrary from './arbitraries.ts';
import { read } from './read-in-pieces.ts';
import { fileBytes, GOOD_FILES } from './shared-files.ts';

function write(fileName: string, content: FileContent): string {
  const written = writeFile(content, fileName);
  if (!written) throw new Error(`${fileName} can't hold ${content.kind}`);
  expect(written.diagnostics).toEqual([]);
  return written.text;
}

/** Writes, reads, writes: the same model, the same bytes. */
function expectRoundTrip(fileName: string, content: FileContent): void {
  const text = write(fileName, content);
  const { value, diagnostics } = read(fileName, text);
  expect(diagnostics.filter((d) => d.severity === 'error')).toEqual([]);
  expectEqual(value, content);
  if (value) expect(write(fileName, value)).toBe(text);
}

describe('any model that is written and read', () => {
  const RUNS = { numRuns: 200 };

  it('any model that is written and read is the same skeleton', () => {
    const several = fc
      .array(arbitrary.skeleton, { minLength: 1, maxLength: 3 })
      .map((all) => all.map((s, i) => ({ ...s, name: i === 0 ? 'x' : `x_${i + 1}` })));
    fc.assert(
      fc.property(several, (skeletons) => expectRoundTrip('x.skel', { kind: 'skel', skeletons })),
      // Twice as many skeletons.
      { numRuns: 100 },
    );
  });

  it('any model that is written and read is the same skin', () => {
    fc.assert(
      fc.property(arbitrary.skin, (skin) => expectRoundTrip('x.skin', { kind: 'skin', skin })),
      RUNS,
    );
  });

  it('any model that is written and read is the same morph', () => {
    fc.assert(
      fc.property(arbitrary.morph, (morph) => expectRoundTrip('x.morph', { kind: 'morph', morph })),
      RUNS,
    );
  });

  it('any model that is written and read is the same take', () => {
    fc.assert(
      fc.property(arbitrary.take, (take) => expectRoundTrip('x.anim', { kind: 'anim', take })),
      RUNS,
    );
  });

  it('any model that is written and read is the same rig', () => {
    fc.assert(
      fc.property(arbitrary.rig, (rig) => expectRoundTrip('x.rig', { kind: 'rig', rig })),
      RUNS,
    );
  });
});

describe('a file at hand that is read and written', () => {
  it.each(GOOD_FILES)('%s gives the same model again', (path) => {
    const { value } = read(path, fileBytes(path));
    expect(value).toBeDefined();
    if (value) expectRoundTrip(path, value);
  });
});

describe('a name that a format can not hold', () => {
  it('a name that a format can not hold is written as one that reads back the same from then on', () => {
    const name = anyText({ minLength: 1, maxLength: 8 });
    fc.assert(
      fc.property(name, name, (rigName, skin) => {
        const first = writeFile({ kind: 'rig', rig: { name: rigName, skin, morphs: [skin] } }, 'x.rig');
        const { value } = read('x.rig', first?.text ?? '');
        expect(value && writeFile(value, 'x.rig')).toEqual({ text: first?.text, diagnostics: [] });
      }),
    );
  });
});
