import { describe, expect, it } from 'vitest';
import { readDump } from '../../src/formats/dump/read.ts';
import { CATALOGUE } from '../../src/teaching/catalogue/all.ts';
import { fitDumps } from '../../src/teaching/dump/fit-dump.ts';
import { Evaluator } from '../../src/teaching/program/evaluator.ts';
import { RIGHT_PROGRAM } from '../../src/teaching/program/program.ts';
import { characterFrom, characterOf, OWN } from './lesson-files.ts';
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

const byCode = (code: string) => {
  const found = CATALOGUE.find((mistake) => mistake.code === code);
  if (!found) throw new Error(`There is no mistake ${code}.`);
  return found.variants;
};

describe('mistakes in how a channel goes on outside its keys', () => {
  const KEYS = 'keys 4 { -0.3 -0.7 -1 0.6 0.5 -0.8 smooth smooth 1 0.9 smooth smooth 1.6 -0.2 -1.9 1.1 }';
  const character = characterFrom(
    'mine.anim',
    `animation { range 0 4 numchannels 3 ${['cycle_offset cycle_offset', 'linear linear', 'constant cycle_offset'].map((each) => `channel { extrapolate ${each} ${KEYS} }`).join(' ')} }`,
  );

  it.each(
    [
      'cycle-offset-missing',
      'cycle-offset-before',
      'cycle-offset-once',
      'cycle-offset-sign',
      'cycle-offset-count',
      'extrapolation-exchanged',
      'linear-extrapolation-slope',
      'linear-extrapolation-tangent',
      'tangent-smooth-halved',
    ].flatMap((code) => byCode(code).map((variant) => [code, variant] as const)),
  )('are told from each other: %s, %o', (code, variant) => {
    const found = compared(character, numbersBy(character, variant.apply(RIGHT_PROGRAM), 'channels'));
    // The ends of smooth tangents have slopes of their own here.
    const detail = code === 'tangent-smooth-halved' ? '' : variant.detail;
    expect(found.causes).toMatchObject([{ code, detail, explains: 3, of: 3 }]);
  });
});

describe('mistakes that make the same numbers', () => {
  const withKeys = (...extrapolations: readonly string[]) =>
    characterFrom(
      'mine.anim',
      `animation { range 0 2 numchannels ${extrapolations.length} ${extrapolations
        .map(
          (each) =>
            `channel { extrapolate ${each} keys 3 { 0 0.1 linear linear 0.2 0.5 smooth smooth 0.6 0.3 flat flat } }`,
        )
        .join(' ')} }`,
    );

  it('are all named: fmod that holds the first value before the keys, and no extrapolation there', () => {
    const character = withKeys('cycle cycle', 'constant linear');
    const [, held] = byCode('modulo-negative').filter(({ isFiner }) => !isFiner);
    const found = compared(character, numbersBy(character, held.apply(RIGHT_PROGRAM), 'channels'));
    expect(found.causes).toMatchObject([
      { code: 'extrapolation-ignored', detail: 'before the first key', explains: 2, of: 2 },
      { code: 'modulo-negative', detail: 'the value of the first key is held', explains: 2, of: 2 },
    ]);
  });

  it.each([
    ['before the first key', 1],
    ['after the last key', 2],
  ] as const)('no extrapolation %s is told from none on either side', (detail, index) => {
    const character = withKeys('linear linear', 'cycle_offset cycle', 'cycle bounce');
    const variant = byCode('extrapolation-ignored')[index];
    const found = compared(character, numbersBy(character, variant.apply(RIGHT_PROGRAM), 'channels'));
    expect(found.causes).toMatchObject([{ code: 'extrapolation-ignored', detail }]);
  });

  it('are other ways to make one where they are equal, as the first weight and the largest', () => {
    const first = byCode('first-attachment-only')[0];
    const found = compared(CRAWLER, numbersBy(CRAWLER, first.apply(RIGHT_PROGRAM), 'vertices'));
    expect(found.causes[0]).toMatchObject({
      detail: 'the first, with its own weight',
      alternatives: ['the one with the largest weight, which it keeps'],
    });
    // A finer form of a rule says nothing beside it.
    const signs = compared(CRAWLER, numbersBy(CRAWLER, byCode('rotation-sign')[0].apply(RIGHT_PROGRAM), 'world'));
    expect(signs.causes[0]).toMatchObject({ code: 'rotation-sign', detail: '−φx', alternatives: [] });
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
