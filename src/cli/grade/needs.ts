/** `--needs`: which parts a submission must have. */

import { formatKindOf, KINDS, openingOf, SAVED_KINDS, type SavedKind } from '../../files/kinds.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { baseName } from '../../model/files.ts';
import type { Kind } from '../options/kinds.ts';
import type { PartGrade } from './grade.ts';

const NUMBERS = ['world', 'local', 'positions', 'vertices', 'normals', 'channels'] as const;
/** The parts of characters, each by the first of its kinds. */
const FILES = SAVED_KINDS.filter((kind, i) => {
  const { content } = KINDS[kind];
  const { as } = openingOf(content);
  return (
    (as === 'characters' || as === 'part') && SAVED_KINDS.findIndex((other) => KINDS[other].content === content) === i
  );
});

/** Something that has to be there, and that has to have been compared. */
export type Need =
  | { readonly numbers: (typeof NUMBERS)[number] }
  | { readonly files: SavedKind }
  /** A file of this name, without its folders. */
  | { readonly name: string };

/** Separated by commas. */
export const NEEDS: Kind<readonly Need[]> = {
  placeholder: 'PART,…',
  what: `${[...NUMBERS, ...FILES].join(', ')}, or names of files such as curves.txt`,
  read(text, misfit) {
    const terms = text
      .split(',')
      .map((term) => term.trim())
      .filter((term) => term !== '');
    return terms.length === 0 ? misfit() : terms.map((term) => needOf(term) ?? misfit(term));
  },
};

function needOf(term: string): Need | undefined {
  const lower = term.toLowerCase();
  const numbers = NUMBERS.find((name) => name === lower);
  if (numbers) return { numbers };
  const files = FILES.find((name) => name === lower.replace(/^\./, ''));
  if (files) return { files };
  return term.includes('.') && formatKindOf(term) ? { name: baseName(term) } : undefined;
}

/** What is needed and was not compared. @param path of the submission, for messages */
export function missingOf(needs: readonly Need[], parts: readonly PartGrade[], path: string): readonly Diagnostic[] {
  return needs.flatMap((need) => {
    const isThere = parts.some((part) => isMet(need, part));
    return isThere ? [] : [withoutPlace('error', 'need-missing', `Expected ${textOf(need)}, found none.`, path)];
  });
}

function isMet(need: Need, { files, compared }: PartGrade): boolean {
  if ('numbers' in need) return compared[need.numbers] > 0;
  return files.some((file) => {
    if ('name' in need) return baseName(file).toLowerCase() === need.name.toLowerCase();
    const kind = SAVED_KINDS.find((saved) => saved === formatKindOf(file));
    return kind !== undefined && KINDS[kind].content === KINDS[need.files].content;
  });
}

function textOf(need: Need): string {
  if ('name' in need) return `the file ${need.name}`;
  if ('files' in need) return `a .${need.files} file`;
  const { numbers } = need;
  return numbers === 'world' || numbers === 'local' ? `${numbers} matrices` : numbers;
}
