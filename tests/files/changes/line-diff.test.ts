import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { commonLines } from '../../../src/files/changes/line-diff.ts';
import { LineIds } from '../../../src/files/changes/text-lines.ts';

const common = (a: readonly string[], b: readonly string[]) => {
  const ids = new LineIds();
  return [...commonLines(ids.of(a), ids.of(b))];
};
const lines = fc.array(fc.constantFrom('a', 'b', 'c', '{', '}', 'x', 'y', 'z'), { maxLength: 30 });

/** The length of the longest common subsequence. */
function most(a: readonly string[], b: readonly string[]): number {
  const row = new Array<number>(b.length + 1).fill(0);
  for (const line of a) {
    let diagonal = 0;
    b.forEach((other, j) => {
      const above = row[j + 1];
      row[j + 1] = line === other ? diagonal + 1 : Math.max(above, row[j]);
      diagonal = above;
    });
  }
  return row[b.length];
}

describe('lines that two texts have in common', () => {
  it('are equal lines in ascending order', () => {
    fc.assert(
      fc.property(lines, lines, (a, b) => {
        const found = common(a, b);
        let last = -1;
        found.forEach((j, i) => {
          if (j < 0) return;
          expect(b[j]).toBe(a[i]);
          expect(j).toBeGreaterThan(last);
          last = j;
        });
      }),
    );
  });

  it('are as many as there can be where no line occurs only once', () => {
    fc.assert(
      fc.property(lines, lines, (a, b) => {
        const [twiceA, twiceB] = [a.flatMap((line) => [line, line]), b.flatMap((line) => [line, line])];
        expect(common(twiceA, twiceB).filter((j) => j >= 0)).toHaveLength(most(twiceA, twiceB));
      }),
    );
  });

  it('are all lines of a text from which some were removed', () => {
    const some = fc.array(fc.tuple(fc.nat(40).map(String), fc.boolean()), { maxLength: 60 });
    fc.assert(
      fc.property(some, (all) => {
        const [a, b] = [all.map(([line]) => line), all.filter(([, stays]) => stays).map(([line]) => line)];
        expect(common(a, b).filter((j) => j >= 0)).toHaveLength(b.length);
        expect(common(b, a).every((j) => j >= 0)).toBe(true);
      }),
    );
  });

  it('a block beside a similar one is told from its first line to its brace, added or removed', () => {
    const one = ['a {', 'x', '}'];
    const two = ['b {', 'x', '}'];
    expect(common(one, [...one, ...two])).toEqual([0, 1, 2]);
    expect(common([...one, ...two], one)).toEqual([0, 1, 2, -1, -1, -1]);
    expect(common([...one, '}'], [...one, ...two, '}'])).toEqual([0, 1, 2, 6]);
  });

  it('of a long text whose rows are all new, what is around them', () => {
    const rows = (word: string) => ['head', ...Array.from({ length: 20_000 }, (_, i) => `${word}${i}`), 'tail'];
    const found = common(rows('a'), rows('b'));
    expect(found.filter((j) => j >= 0)).toEqual([0, 20_001]);
    const some = rows('a').map((row, i) => (i % 2 ? row : `${row}'`));
    expect(common(rows('a'), some).filter((j) => j >= 0)).toHaveLength(10_001);
  });
});
