/**
 * The words of the glossary (CONTRIBUTING.md) and the rules of its English, held over what people read: texts of the
 * source, and the documents. Counts of what is left in names and comments can only fall.
 */
import { readdirSync, readFileSync } from 'node:fs';
import { join, relative, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { type SourceWord, wordsOf } from './helpers/source-words.ts';

const ROOT = fileURLToPath(new URL('../', import.meta.url));

const filesIn = (folder: string, ending: string): readonly string[] =>
  readdirSync(join(ROOT, folder), { recursive: true, encoding: 'utf8' })
    .filter((name) => name.endsWith(ending))
    .map((name) => join(ROOT, folder, name));

interface Place extends SourceWord {
  readonly file: string;
}

const placed = (path: string, words: readonly SourceWord[]): readonly Place[] =>
  words.map((word) => ({ ...word, file: relative(ROOT, path).split(sep).join('/') }));

const SOURCES = filesIn('src', '.ts').map((path) => ({ path, ...wordsOf(readFileSync(path, 'utf8')) }));

/** Texts with two words or more that people see: not shaders, styles, and names of classes. */
const TEXTS = SOURCES.flatMap(({ path, texts }) => placed(path, texts)).filter(
  ({ file, text }) =>
    /[a-z]{2} [a-z…“"(]/.test(text) &&
    !/^[a-z0-9… -]*[a-z]-[a-z0-9… -]*$/.test(text) &&
    !/^src\/(view|cli\/grade\/style)|vocabulary/.test(file),
);

/** Lines of the documents, without code. */
const DOCUMENTS = ['README.md', 'CHANGELOG.md']
  .map((name) => join(ROOT, name))
  .concat(filesIn('docs', '.md'))
  .flatMap((path) => {
    const text = readFileSync(path, 'utf8').replace(/```[\s\S]*?```|`[^`\n]*`|\]\([^)]*\)/g, (code) =>
      code.replace(/[^\n]/g, ' '),
    );
    return placed(
      path,
      text.split('\n').map((line, i) => ({ text: line, line: i + 1 })),
    );
  });

interface Rule {
  readonly not: RegExp;
  readonly say: string;
  /** Texts in which it is right, each with its reason. */
  readonly but?: readonly (readonly [text: RegExp, reason: string])[];
}

/** What the English of messages, tooltips and documents avoids. */
const RULES: readonly Rule[] = [
  { not: /\b(is|are|was|were|been) (told|said|asked)\b/, say: 'Marrow tells, names, asks' },
  { not: /\bat hand\b/, say: 'available' },
  {
    not: /\bstands?\b/,
    say: 'is, applies, has',
    but: [[/feet that stand|foot that stands|stands? on a floor/, 'feet and characters do']],
  },
  { not: /\bwhere (there (is|are)|none|any)\b/, say: 'if there is, or, if none' },
  {
    not: /(?<!\bthere )\b(is|are) no (?!longer|more\b)[a-z]|\b(is|are) none\b/i,
    say: 'is not a',
  },
  { not: /\bbehind\b/, say: 'after', but: [[/points 30° behind/, 'a direction']] },
  { not: /\b(above|below) 0\b/, say: 'greater than 0, less than 0' },
  { not: /\bof those that\b|\bthose who\b|\bsuch as have\b/, say: 'the ones that' },
  {
    not: /\belse\b/,
    say: 'otherwise; or, if none',
    but: [[/(everything|nothing|something|anywhere) else/i, 'an adverb']],
  },
  { not: /(?<![−\d.,-])\b1 (?!needs|makes|is)[a-z]+s\b/, say: 'the singular' },
  { not: /\bone an? [a-z]+\b|\ba (line|row|frame|key) an? [a-z]+\b/, say: 'one per line' },
  { not: /\bgo(es|ing)? on\b/, say: 'continue' },
  { not: /\bmend(s|ed|ing)?\b/, say: 'fix, correct' },
  { not: /\bexchang(es?|ed|ing)\b/, say: 'swap', but: [[/exchange characters with/, 'files between programs']] },
  { not: /\banew\b|\bto and fro\b|\bwithout a word\b/, say: 'again, back and forth, silently' },
  { not: /\balready[.!]?$/, say: '“already” before the verb’s end' },
  {
    not: /\b(colors?|normaliz\w+|gray|centers?|recogniz\w+|optimiz\w+|meters?|labeled|behaviors?|favorites?)\b/i,
    say: 'British spelling',
    but: [[/\b(of|after|or) color\b|^color |color-mix/, 'the keyword of .skin, and CSS']],
  },
];

/** Words of the glossary’s *not* column that mean something else as often: each is right in one of its meanings. */
const AMBIGUOUS: Readonly<Record<string, string>> = {
  numbers: 'what another program printed',
  drop: 'files are dropped on the page',
  'this moment': 'also “This takes a moment”',
  here: 'of the pointer: “Start here”',
  warning: 'the severity of a problem',
  rate: 'of frames',
  branch: 'a joint branches from a limb',
  copy: 'to the clipboard',
  error: 'of a file, and of a number',
  normalise: 'weights, normals',
  sample: 'a captured value at a frame, and the act',
  'what is wrong': 'finding it is what compare does',
  folder: 'of files',
  chosen: 'an option of a dialog',
  put: '“Put feet on the ground”',
  clip: 'what GPUs do',
  seen: 'of a vertex by a bone',
  'take on': 'a take on another character',
  'take as': 'a take as a file',
  'starts at': 'a range',
  'last joint': 'the last of all',
  figure: 'a number of the benchmarks, and HTML’s element',
  trail: 'people search for it',
};

/** Unwanted terms by the term that replaces them, from the glossary. */
function unwantedTerms(): readonly (readonly [term: string, not: string])[] {
  const text = readFileSync(join(ROOT, 'CONTRIBUTING.md'), 'utf8');
  return [...text.slice(text.indexOf('## Words')).matchAll(/^\| ([^|]+) \| [^|]* \| ([^|]+) \|$/gm)]
    .filter(([, term, not]) => term !== 'term' && !term.startsWith('-') && not.trim() !== '')
    .flatMap(([, term, not]) => not.split(',').map((each): [string, string] => [term, each.trim()]));
}

const found = (places: readonly Place[], { not, but = [] }: Rule): readonly string[] =>
  places
    .filter(({ text }) => not.test(text) && !but.some(([right]) => right.test(text)))
    .map(({ file, line, text }) => `${file}:${line}: ${text.trim().slice(0, 160)}`);

describe('the words that people read', () => {
  it.each(RULES.map((rule) => [rule.say, rule] as const))('texts and documents say: %s', (_, rule) => {
    expect(found([...TEXTS, ...DOCUMENTS], rule)).toEqual([]);
  });

  it('no text or document has a term that the glossary replaces', () => {
    const unwanted = unwantedTerms();
    expect(unwanted.length).toBeGreaterThan(50);
    const hits = unwanted
      .filter(([, not]) => AMBIGUOUS[not] === undefined)
      .flatMap(([term, not]) =>
        found([...TEXTS, ...DOCUMENTS], { not: new RegExp(`\\b${not}\\b`, 'i'), say: term }).map(
          (hit) => `${hit} (${term}, not ${not})`,
        ),
      );
    expect(hits).toEqual([]);
  });
});

/**
 * What names and comments still have of it, rounded up: these can only fall. A name counts once for each place. `clip`
 * is what `.anim` holds in the code, so not all of it goes.
 */
const CEILINGS: readonly (readonly [what: string, count: () => number, most: number])[] = [
  ['names with clip', () => namesWith('clip'), 20],
  ['names with figure', () => namesWith('figure'), 40],
  ['constants called MOST_ or LEAST_', () => namesLike(/^(MOST|LEAST)_/), 0],
  ['comments that begin with a bare Of', () => commentsLike(/^Of\b/), 260],
  ['comments that begin with a bare What', () => commentsLike(/^What\b/), 560],
  ['comments with is told, said or asked', () => commentsLike(/\b(is|are|was|were|been) (told|said|asked)\b/), 130],
  ['comments with behind', () => commentsLike(/\bbehind\b/), 80],
  ['comments with stand or stands', () => commentsLike(/\bstands?\b/), 60],
  ['comments with at hand, mend or go on', () => commentsLike(/\bat hand\b|\bmend|\bgo(es|ing)? on\b/), 5],
  // One is the title of a paper.
  ['comments with American spelling', () => commentsLike(/\b(normaliz|optimiz|recogniz|behavior|gray\b)/), 1],
];

const COMMENTS = SOURCES.flatMap(({ comments }) => comments);
const NAMES = SOURCES.flatMap(({ names }) => names);

const commentsLike = (pattern: RegExp) => COMMENTS.filter(({ text }) => pattern.test(text)).length;
const namesLike = (pattern: RegExp) => NAMES.filter(({ text }) => pattern.test(text)).length;

/** Names of which the word is a part: `figure`, `figures`, `shownFigure`. */
function namesWith(word: string): number {
  const capital = word[0].toUpperCase() + word.slice(1);
  return namesLike(new RegExp(`(^|_)${word}s?(?=[A-Z_\\d]|$)|${capital}s?(?=[A-Z_\\d]|$)`));
}

describe('the words of the code', () => {
  it.each(CEILINGS)('there are no more %s than there were', (_, count, most) => {
    expect(count()).toBeLessThanOrEqual(most);
  });
});
