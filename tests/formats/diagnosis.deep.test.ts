/**
 * Real files damaged at random by one token, with fixed seeds: the first problem told is on the very line, and hardly
 * anything follows. All shares, with more cases: `MARROW_CASES=200 npx vitest run tests/formats/diagnosis.deep`.
 */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { ALL_BVH, bvhBytes } from '../helpers/bvh-files.ts';
import { expectEqual } from '../helpers/equal.ts';
import { conformance, describeShared, sharedBytes } from '../helpers/shared.ts';
import { type Damaged, Intact, newProblems, OPERATIONS, randomOf } from './damage.ts';
import { bytesOf, read, readAsOpened, told } from './read-in-pieces.ts';
import { type RealFile, realFiles } from './real-files.ts';
import { fileBytes, GOOD_FILES } from './shared-files.ts';

/** Of each operation, for each kind of file. */
const CASES = Number(process.env.MARROW_CASES ?? 20);
/** Of few, one more or less is several in a hundred; rigs are so short that more of them take no time. */
const casesOf = (kind: string) => (kind === 'rig' ? 5 * CASES : CASES);
/** Larger files have a turn only in so many rounds: they take most of the time, and are like the others. */
const LARGE = 200_000;
const TURN = 8;
/** Smaller ones are read in pieces too, every other time. */
const SMALL = 30_000;

interface Score {
  tried: number;
  /** Brought an error or a warning that the intact file does not. */
  told: number;
  onLine: number;
  /** With at most one more. */
  short: number;
}

/** Which file is damaged, case by case. */
function turns(files: readonly RealFile[], cases: number): readonly RealFile[] {
  const chosen: RealFile[] = [];
  for (let round = 0; chosen.length < cases; round++) {
    chosen.push(...files.filter(({ text }) => text.length < LARGE || round % TURN === 0));
  }
  return chosen.slice(0, cases);
}

describe('a real file damaged by one token', () => {
  const kinds = [...realFiles()];

  it.each(kinds)('.%s: the very line is named in at least 95 of 100, with at most one follower', (kind, files) => {
    const intact = new Map(files.map((file) => [file, new Intact(file.text)]));
    const before = new Map(files.map(({ name, text }) => [name, readAsOpened(name, text).diagnostics]));
    const score: Score = { tried: 0, told: 0, onLine: 0, short: 0 };
    const missed: string[] = [];
    const long: string[] = [];
    const cut = randomOf(7);
    const judge = (file: RealFile, damaged: Damaged) => {
      const bytes = bytesOf(damaged.text);
      const { value, diagnostics } = readAsOpened(file.name, bytes);
      score.tried++;
      expect(value === undefined).toBe(diagnostics.some(({ severity }) => severity === 'error'));
      if (bytes.length < SMALL && score.tried % 2 === 0) {
        const cuts = Array.from({ length: 5 }, () => Math.floor(cut() * bytes.length));
        expectEqual(readAsOpened(file.name, bytes, cuts), { ...(value && { value }), diagnostics });
      }
      for (const { excerpt } of diagnostics) {
        expect(excerpt?.text.length ?? 0).toBeLessThanOrEqual(200);
        expect(excerpt?.caret ?? 0).toBeLessThanOrEqual(excerpt?.text.length ?? 0);
      }
      const found = newProblems(before.get(file.name) ?? [], diagnostics);
      if (found.length === 0) return;
      score.told++;
      if (found[0].line >= damaged.first && found[0].line <= damaged.last) score.onLine++;
      else missed.push(`${file.name}: ${damaged.what}, told on line ${found[0].line}: ${found[0].message}`);
      if (found.length <= 2) score.short++;
      else long.push(`${file.name}: ${damaged.what}, told ${told({ diagnostics: found }).join(', ')}`);
    };
    for (const [i, operation] of OPERATIONS.entries()) {
      const random = randomOf(i + 1);
      for (const file of turns(files, casesOf(kind))) {
        const damaged = intact.get(file)?.damage(operation, random);
        if (damaged) judge(file, damaged);
      }
    }
    const share = (part: number) => `${((100 * part) / score.told).toFixed(1)} %`;
    if (process.env.MARROW_CASES) {
      const shares = `on the line ${share(score.onLine)}, at most one follower ${share(score.short)}`;
      console.info(`.${kind}: ${score.tried} damaged, ${score.tried - score.told} of them legal; ${shares}`);
    }
    expect(score.told).toBeGreaterThan(casesOf(kind));
    expect(score.onLine / score.told, missed.join('\n')).toBeGreaterThanOrEqual(0.95);
    expect(score.short / score.told, long.join('\n')).toBeGreaterThanOrEqual(0.99);
  });
});

describe('a file that is not damaged', () => {
  const captures = ALL_BVH.map((name): [string, Uint8Array] => [name, bvhBytes(name)]);
  const files = [...GOOD_FILES.map((path): [string, Uint8Array] => [path, fileBytes(path)]), ...captures];

  it.each(files)('%s is told of as its reader tells it', (path, bytes) => {
    expectEqual(readAsOpened(path, bytes).diagnostics, read(path, bytes).diagnostics);
  });
});

describe('a file with the extension of another kind', () => {
  const kinds = [...realFiles()];
  /** Two forms of one thing, recognised by the reader. */
  const form = (kind: string) => (kind === 'axskel' ? 'skel' : kind);

  it.each(kinds)('.%s is recognised under any other extension, and nothing else is told', (kind, files) => {
    for (const [other] of kinds) {
      if (form(other) === form(kind)) continue;
      for (const { text } of files.filter((file) => file.text.length < LARGE)) {
        const { diagnostics } = readAsOpened(`x.${other}`, text);
        expect(diagnostics).toMatchObject([{ code: 'other-kind', line: 1 }]);
        expect(diagnostics[0].message).toContain(`looks like a .${kind} file, not a .${other}.`);
      }
    }
  });
});

interface MalformedCase {
  readonly file: string;
  readonly accept_lines: readonly number[];
  readonly what: string;
}

describeShared('the broken motion capture files of the reference, as opened', () => {
  const { malformed } = conformance<{ malformed: readonly MalformedCase[] }>('bvh-positions.json');

  it.each(malformed)('$file as opened: $what', ({ file, accept_lines: lines }) => {
    const problems = readAsOpened(file, sharedBytes(`data/bvh/malformed/${file}`)).diagnostics;
    expect(problems).toHaveLength(1);
    expect(lines).toContain(problems[0].line);
  });
});

it('reading never throws, and leaves a file with errors in errors, whatever it holds', () => {
  const word = fc.constantFrom('balljoint', 'a', '{', '}', 'offset', 'pose', '0', '1.5', '2x', '\t', '"', '骨', 'rig');
  const gap = fc.constantFrom(' ', '\n', '\r', '\r\r\n', '\n\t', '');
  const text = fc.array(fc.tuple(word, gap), { maxLength: 40 }).map((parts) => parts.flat().join(''));
  const property = fc.property(text, fc.constantFrom('skel', 'skin', 'anim', 'rig', 'bvh', 'pose'), (all, kind) => {
    const { value, diagnostics } = readAsOpened(`x.${kind}`, all);
    expect(value === undefined).toBe(diagnostics.some(({ severity }) => severity === 'error'));
    const lines = all.split(/\r*\n|\r/).length;
    for (const { line, excerpt } of diagnostics) {
      expect(line).toBeLessThanOrEqual(lines);
      expect(excerpt?.text.length ?? 0).toBeLessThanOrEqual(200);
    }
  });
  fc.assert(property, { numRuns: 200 });
});
