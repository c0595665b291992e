import { describe, expect, it } from 'vitest';
import { readDump } from '../../src/formats/dump/read.ts';
import { CATALOGUE } from '../../src/lesson/catalogue/all.ts';
import { Evaluator } from '../../src/lesson/evaluator.ts';
import { fitDumps } from '../../src/lesson/fit-dump.ts';
import { RIGHT_PROGRAM } from '../../src/lesson/program.ts';
import { characterOf, OWN } from './lesson-files.ts';
import { compared, kindsOf, namedIn, numbersBy, positionsOf, VARIANTS } from './planted.ts';
import { MATRIX_PRINTERS, NUMBER_STYLES, POINT_PRINTERS } from './printers.ts';

const CRAWLER = characterOf(...OWN.crawler);
const TANGENTS = characterOf(...OWN.tangents);
const ALL = { local: true, vertices: true, normals: true };

describe('the catalogue of mistakes', () => {
  it('has each code once, with a sentence, a formula and variants', () => {
    const codes = CATALOGUE.map(({ code }) => code);
    expect(new Set(codes).size).toBe(codes.length);
    for (const { code, sentence, formula, variants } of CATALOGUE) {
      expect(variants.length, code).toBeGreaterThan(0);
      expect(formula, code).not.toBe('');
      for (const { detail } of variants) expect(sentence(detail), code).toMatch(/^[A-Zcbf].*\.$/);
    }
  });

  it.each(VARIANTS.map(({ code, variant }) => [code, variant] as const))(
    '%s changes the program, and nothing of the right one',
    (_, variant) => {
      const before = JSON.stringify(RIGHT_PROGRAM);
      expect(JSON.stringify(variant.apply(RIGHT_PROGRAM))).not.toBe(before);
      expect(JSON.stringify(RIGHT_PROGRAM)).toBe(before);
    },
  );
});

describe('a planted mistake', () => {
  // Two characters here; all of them, and pairs, in the deep test.
  const seen = new Set<string>();
  it.each(CATALOGUE)('is named wherever it shows: $code', ({ code, variants }) => {
    for (const character of [CRAWLER, TANGENTS]) {
      for (const kind of kindsOf(character).filter((each) => each !== 'local' && each !== 'positions')) {
        for (const variant of variants.slice(0, 1)) {
          const found = compared(character, numbersBy(character, variant.apply(RIGHT_PROGRAM), kind));
          if (found.agrees) continue;
          seen.add(code);
          expect(namedIn(found), `${kind} ${variant.detail}`).toContain(code);
        }
      }
    }
  });

  it('is one of most of the catalogue', () => {
    expect(seen.size).toBeGreaterThan(30);
  });

  it('is not seen in noise within the tolerance, nor named for noise above it', () => {
    for (const kind of kindsOf(CRAWLER)) {
      for (const [size, agrees] of [
        [2e-5, true],
        [5e-3, false],
      ] as const) {
        const targets = numbersBy(CRAWLER, RIGHT_PROGRAM, kind);
        const values = kind === 'channels' ? targets.channels.values : (targets.frames[0][kind] ?? new Float64Array(0));
        values.forEach((value, i) => {
          values[i] = value + size * Math.sin(12.9898 * i);
        });
        expect(compared(CRAWLER, targets), `${kind} ${size}`).toMatchObject({ agrees, causes: [] });
      }
    }
  });
});

describe('our own numbers', () => {
  const { world, vertices, normals } = new Evaluator(CRAWLER).frame(RIGHT_PROGRAM, 0.8, ALL);
  const names = CRAWLER.skeleton?.joints.map(({ name }) => name) ?? [];
  const matrices = Array.from({ length: world.length / 16 }, (_, j) => world.slice(16 * j, 16 * j + 16));
  const lists = { vertices: vertices.slice(), normals: normals.slice(), positions: positionsOf(world) };

  it.each(MATRIX_PRINTERS)(
    'agree and are told by rows or columns, printed as $name',
    ({ print, order, numbers, extension }) => {
      for (const number of NUMBER_STYLES) {
        const text = print(matrices, number, names);
        const { targets, found } = read(text, `mine@0.8.${extension}`);
        expect(targets?.layout, text.slice(0, 300)).toEqual({ order, numbers });
        expect(found, text.slice(0, 300)).toMatchObject({ agrees: true, compared: { world: names.length } });
      }
    },
  );

  it.each(POINT_PRINTERS)('agree as points, printed as $name', ({ print, extension }) => {
    for (const kind of ['vertices', 'normals', 'positions'] as const) {
      for (const number of NUMBER_STYLES) {
        const text = print(lists[kind], number, kind);
        const { found } = read(text, `mine@0.8.${extension}`);
        expect(found, text.slice(0, 300)).toMatchObject({ agrees: true, compared: { [kind]: lists[kind].length / 3 } });
      }
    }
  });

  function read(text: string, name: string) {
    const { value, diagnostics } = readDump(text, name);
    expect(diagnostics).toEqual([]);
    if (!value) throw new Error('Expected a dump.');
    const { targets, diagnostics: misfits } = fitDumps(CRAWLER, [{ fileName: name, dump: value }], undefined);
    expect(misfits, text.slice(0, 300)).toEqual([]);
    return { targets, found: targets && compared(CRAWLER, targets) };
  }
});
