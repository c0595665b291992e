/** Decodes a kept session: the inverse of `encode.ts`. */

import type { ParsedFile } from '../../model/files.ts';
import { UserError } from '../../model/user-error.ts';
import { type Encoded, isNumbers, NUMBERS_TYPES, type StorableNumbers, type StoredNumbers } from './encoded.ts';

/** A session that can't be restored; the message is a whole sentence. */
export class RestoreError extends UserError {
  override readonly name = 'RestoreError';
}

/** Places in pieces that trees refer to, each node once. */
export function storedNumbers(trees: readonly Encoded[]): readonly StoredNumbers[] {
  const found = new Set<StoredNumbers>();
  const seen = new Set<unknown>();
  const walk = (node: Encoded): void => {
    if (typeof node !== 'object' || node === null || isNumbers(node) || seen.has(node)) return;
    seen.add(node);
    if (node.is === 'numbers') found.add(node);
    else if (node.is === 'list') node.of.forEach(walk);
    else if (node.is === 'object') Object.values(node.of).forEach(walk);
  };
  trees.forEach(walk);
  return [...found];
}

/** An array to be filled from the pieces. */
export function emptyNumbers({ type, bytes }: StoredNumbers): StorableNumbers {
  const Type = NUMBERS_TYPES[type];
  return new Type(bytes / Type.BYTES_PER_ELEMENT);
}

/** What trees refer to. */
export interface Referred {
  /** Those that `part`s refer to, read again. */
  readonly files: readonly (ParsedFile | undefined)[];
  /** One for each of `storedNumbers`. */
  readonly arrays: ReadonlyMap<StoredNumbers, StorableNumbers>;
  /** Items of lists, encoded. */
  readonly chunks: ReadonlyMap<number, readonly Encoded[]>;
}

/**
 * The value that a tree encodes. Shared values are shared again; parts of files are the files' own objects.
 *
 * @throws RestoreError if something that it refers to is missing
 */
export function decode(tree: Encoded, { files, arrays, chunks }: Referred): unknown {
  const values = new Map<object, unknown>();
  const valueAt = (node: Encoded): unknown => {
    if (typeof node !== 'object' || node === null || isNumbers(node)) return node;
    if (values.has(node)) return values.get(node);
    const value = make(node);
    values.set(node, value);
    return value;
  };
  const items = new Map<number, readonly unknown[]>();
  const itemsOf = (chunk: number): readonly unknown[] => {
    const known = items.get(chunk) ?? chunks.get(chunk)?.map(valueAt);
    if (!known) throw new RestoreError('Part of the stored session is missing.');
    items.set(chunk, known);
    return known;
  };
  const make = (node: Exclude<Encoded, undefined | null | boolean | number | string | StorableNumbers>): unknown => {
    switch (node.is) {
      case 'object':
        return Object.fromEntries(Object.entries(node.of).map(([key, inner]) => [key, valueAt(inner)]));
      case 'list':
        return node.of.map(valueAt);
      case 'plain':
      case 'other':
        return node.of;
      case 'chunks':
        return node.of.flatMap(itemsOf);
      case 'part': {
        const file = files[node.file];
        if (!file) throw new RestoreError('A file of the stored session is missing.');
        return partOf(file, node.path);
      }
      case 'numbers': {
        const array = arrays.get(node);
        if (!array) throw new RestoreError('Part of the stored session is missing.');
        return array;
      }
    }
  };
  return valueAt(tree);
}

function partOf(file: ParsedFile, path: readonly (string | number)[]): unknown {
  let value: unknown = file;
  for (const key of path) {
    const at: unknown = value;
    if (typeof at !== 'object' || at === null) throw changed(file);
    // Own properties only; the value is checked in the next step.
    value = Object.hasOwn(at, key) ? (at as Record<string | number, unknown>)[key] : undefined;
    if (value === undefined) throw changed(file);
  }
  return value;
}

function changed({ source }: ParsedFile): RestoreError {
  return new RestoreError(`${source.name} is read differently by this version of Marrow.`);
}
