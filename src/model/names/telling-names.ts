/**
 * Names that tell things apart which came from several files: characters that all say `walker`, takes that are all
 * called `mixamo.com`. Those that share a name are named by their input instead; all others keep theirs.
 *
 *     hero/run.fbx   mixamo.com            →  run
 *     hero/all.fbx   mixamo.com, Take 001  →  all_mixamo.com, Take 001
 *     ada/test.skel, bob/test.skel  test   →  ada_test, bob_test
 */

import { folderOf, type SourceFile, stemOf } from '../files.ts';
import { DistinctNames } from './distinct-names.ts';

/** A name as a file gives it, with the file that it came from. */
export interface InputName {
  readonly name: string;
  readonly input: SourceFile;
  /** Whether the input has nothing else of this kind, so that its own name says enough. */
  readonly isOnly: boolean;
}

/**
 * The names in order, all different; file systems may ignore case, so this does.
 * @param taken names of other things, which stay as they are
 */
export function tellingNames(given: readonly InputName[], taken: Iterable<string> = []): readonly string[] {
  const distinct = new DistinctNames(taken);
  const groups = new Map<string, InputName[]>();
  for (const one of given) {
    const group = groups.get(key(one.name));
    if (group) group.push(one);
    else groups.set(key(one.name), [one]);
  }
  const names = new Map<InputName, string>();
  const shared: (readonly InputName[])[] = [];
  for (const group of groups.values()) {
    const [one] = group;
    if (group.length > 1 || distinct.has(one.name)) shared.push(group);
    else names.set(one, one.name);
  }
  for (const name of names.values()) distinct.add(name);
  for (const group of shared) {
    for (const [i, name] of namesByInput(group, distinct).entries()) names.set(group[i], distinct.add(name));
  }
  return given.map((one) => names.get(one) ?? one.name);
}

/** One of many in a folder: after its input, unless its name begins with that already. @param inputName its stem */
export function nameByInput(
  { name, isOnly = false }: { readonly name: string; readonly isOnly?: boolean },
  inputName: string,
): string {
  if (isOnly) return inputName;
  return key(name).startsWith(key(inputName)) ? name : `${inputName}_${name}`;
}

/** With as many folders as tell them apart. */
function namesByInput(group: readonly InputName[], used: DistinctNames): readonly string[] {
  const folders = group.map(({ input }) => foldersOf(input));
  const most = Math.max(...folders.map(({ length }) => length));
  let names: readonly string[] = [];
  for (let count = 0; count <= most; count++) {
    names = group.map((one, i) => {
      const above = folders[i].slice(Math.max(0, folders[i].length - count));
      return nameByInput(one, [...above, stemOf(one.input)].join('_'));
    });
    if (new Set(names.map(key)).size === names.length && !names.some((name) => used.has(name))) break;
  }
  return names;
}

function foldersOf(input: SourceFile): readonly string[] {
  return folderOf(input)
    .split('/')
    .filter((folder) => !['', '.', '..'].includes(folder));
}

function key(name: string): string {
  return name.toLowerCase();
}
