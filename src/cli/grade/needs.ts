/** `--needs`: which parts a submission must have. */

import { formatOf } from '../../files/readers.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { baseName } from '../../model/files.ts';
import type { Kind } from '../options/kinds.ts';
import type { PartGrade } from './grade.ts';

const NUMBERS = ['world', 'local', 'positions', 'vertices', 'normals', 'channels'] as const;
const FILES = ['skel', 'skin', 'morph', 'anim', 'bvh', 'asf', 'amc'] as const;

/** Something that has to be there, and that has to have been compared. */
export type Need =
  | { readonly numbers: (typeof NUMBERS)[number] }
  | { readonly files: (typeof FILES)[number] }
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
  return term.includes('.') && formatOf(term) ? { name: baseName(term) } : undefined;
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
  const isMeant = (file: string) =>
    'name' in need ? baseName(file).toLowerCase() === need.name.toLowerCase() : formatOf(file)?.kind === need.files;
  return files.some(isMeant);
}

function textOf(need: Need): string {
  if ('name' in need) return `the file ${need.name}`;
  if ('files' in need) return `a .${need.files} file`;
  const { numbers } = need;
  return numbers === 'world' || numbers === 'local' ? `${numbers} matrices` : numbers;
}
