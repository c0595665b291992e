/**
 * Decides which of the files opened together belong to each other:
 *
 * 1. a `.rig` binds the files that it names, looked up by base name (its own folder first);
 * 2. any other skin, morph or anim belongs to the skeleton in the same folder whose stem is the longest prefix of its
 * own (`wasp_walk.anim` → `wasp.skel`), or to the only skeleton;
 * 3. the rest has no skeleton here; `open-files.ts` assigns it to characters of the document.
 *
 * Files with errors take part, so that no character is assembled with a part missing.
 */
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import {
  type BrokenFile,
  baseName,
  type FileKind,
  type FileNaming,
  folderOf,
  type ParsedFile,
  type SourceFile,
  sameName,
  stemOf,
} from '../../model/files.ts';
import { type FormatKind, KINDS, openingOf, type Role } from '../kinds.ts';

/** A given file, read or broken. */
export type ReadFile = ParsedFile | (BrokenFile & { readonly broken: true });

/** The files of one skeleton. */
export interface FileGroup {
  /** The name of the `.rig` that binds the group, if any. */
  readonly name?: string;
  /** A file with skeletons; absent if a `.rig` names a skin without a skeleton. */
  readonly skeleton?: ReadFile;
  /** Skins, morphs and anims: those named by a `.rig` first, in its order, then the others in the given order. */
  readonly parts: ReadFile[];
  /** The `.rig` files themselves. */
  readonly rigs: ReadFile[];
}

/** Files that may belong to a character that is already open. */
export type LooseRole = Exclude<Role, 'characters' | 'rig'>;

export interface Grouping {
  readonly groups: readonly FileGroup[];
  /** By role: what belongs to no skeleton among the files. */
  readonly loose: Readonly<Record<LooseRole, readonly ReadFile[]>>;
  /** Rigs with errors, or none of whose files was given. */
  readonly idleRigs: readonly ReadFile[];
  readonly diagnostics: readonly Diagnostic[];
}

export function isBroken(file: ReadFile): file is BrokenFile & { readonly broken: true } {
  return 'broken' in file;
}

export function isRead(file: ReadFile): file is ParsedFile {
  return !isBroken(file);
}

export function groupFiles(files: readonly ReadFile[], called: FileNaming): Grouping {
  const diagnostics: Diagnostic[] = [];
  const groups: { -readonly [K in keyof FileGroup]: FileGroup[K] }[] = [];
  const idleRigs: ReadFile[] = [];
  const taken = new Set<ReadFile>();
  const named = byName(files);
  const bySkeleton = new Map<ReadFile, (typeof groups)[number]>();

  for (const file of files) {
    if (file.kind !== 'rig') continue;
    if (isBroken(file)) {
      idleRigs.push(file);
      continue;
    }
    const { rig } = file;
    const find = (kind: FileKind & FormatKind, name: string | undefined) => {
      if (name === undefined) return undefined;
      const found = lookUp(named, file, kind, name);
      if (!found) diagnostics.push(partNotGiven(called(file.source), kind, name));
      return found;
    };
    const skeleton = find('skel', rig.skeleton);
    const wanted = [
      find('skin', rig.skin),
      ...rig.morphs.map((morph) => find('morph', morph)),
      find('anim', rig.animation),
    ];
    const parts = wanted.filter((part) => part !== undefined);
    if (!skeleton && parts.length === 0) {
      idleRigs.push(file);
      continue;
    }
    const shared = skeleton && bySkeleton.get(skeleton);
    if (shared) {
      // Two rigs with the same skeleton: the second's skin and animation are alternatives.
      shared.parts.push(...parts.filter((part) => !shared.parts.includes(part)));
      shared.rigs.push(file);
    } else {
      const group = { name: rig.name, ...(skeleton && { skeleton }), parts, rigs: [file] };
      groups.push(group);
      if (skeleton) bySkeleton.set(skeleton, group);
    }
    for (const part of [skeleton, ...parts]) if (part) taken.add(part);
  }

  for (const file of files) {
    if (isSkeleton(file) && !taken.has(file)) groups.push({ skeleton: file, parts: [], rigs: [] });
  }

  // Poses are matched to characters by their joints, images by the names in skins.
  const loose: Record<LooseRole, ReadFile[]> = { part: [], markers: [], poses: [], texture: [], dump: [] };
  const skeletonFor = skeletonsFor(groups);
  for (const file of files) {
    const { as } = openingOf(file.kind);
    if (as === 'characters' || as === 'rig' || taken.has(file)) continue;
    const group = as === 'part' ? skeletonFor(file) : undefined;
    (group?.parts ?? loose[as]).push(file);
  }
  return { groups, loose, idleRigs, diagnostics };
}

/** Whether the file is a `.rig` that names the other as a part. */
export function namesFile(file: ParsedFile, other: SourceFile): boolean {
  if (file.kind !== 'rig') return false;
  const { skeleton, skin, morphs, animation } = file.rig;
  return [skeleton, skin, animation, ...morphs].some(
    (part) => part !== undefined && sameName(baseName(part), other.name),
  );
}

/** How well a skeleton's stem matches a part's: the length of the prefix; 0 if it is none. */
export function prefixFit(skeletonStem: string, partStem: string): number {
  return partStem.toLowerCase().startsWith(skeletonStem.toLowerCase()) ? skeletonStem.length : 0;
}

function isSkeleton({ kind }: ReadFile): boolean {
  return openingOf(kind).as === 'characters';
}

function takesParts({ kind }: ReadFile): boolean {
  const opening = openingOf(kind);
  return opening.as === 'characters' && opening.takesParts;
}

/** Finds the group of a part. Skeletons are looked up by folder and stem: both may be thousands. */
function skeletonsFor<G extends FileGroup>(groups: readonly G[]): (part: ReadFile) => G | undefined {
  const skeletons = groups.filter((g) => g.skeleton && takesParts(g.skeleton));
  const folders = new Map<string, { readonly all: G[]; readonly byStem: Map<string, G> }>();
  for (const group of skeletons) {
    if (!group.skeleton) continue;
    const { source } = group.skeleton;
    const folder = folders.get(folderOf(source)) ?? { all: [], byStem: new Map<string, G>() };
    folders.set(folderOf(source), folder);
    folder.all.push(group);
    const stem = stemOf(source).toLowerCase();
    if (!folder.byStem.has(stem)) folder.byStem.set(stem, group);
  }
  return ({ source }) => {
    const there = folders.get(folderOf(source));
    // None in its own folder: use the only skeleton given.
    if (!there) return skeletons.length === 1 ? skeletons[0] : undefined;
    const stem = stemOf(source).toLowerCase();
    for (let length = stem.length; length > 0; length--) {
      const group = there.byStem.get(stem.slice(0, length));
      if (group) return group;
    }
    return there.all.length === 1 ? there.all[0] : undefined;
  };
}

type FilesByName = ReadonlyMap<string, readonly ReadFile[]>;

/** By kind and base name, without case: as a `.rig` names them. */
function byName(files: readonly ReadFile[]): FilesByName {
  const named = new Map<string, ReadFile[]>();
  for (const file of files) {
    const key = nameKey(file.kind, file.source.name);
    const same = named.get(key);
    if (same) same.push(file);
    else named.set(key, [file]);
  }
  return named;
}

function nameKey(kind: FileKind, name: string): string {
  return `${kind} ${name.toLowerCase()}`;
}

/** By base name, ignoring folders in the `.rig`; files in the rig's own folder take precedence. */
function lookUp(files: FilesByName, rig: ReadFile, kind: FileKind, name: string): ReadFile | undefined {
  const fits = files.get(nameKey(kind, baseName(name)));
  return fits?.find((f) => folderOf(f.source) === folderOf(rig.source)) ?? fits?.[0];
}

function partNotGiven(rig: string, kind: FormatKind, name: string): Diagnostic {
  const message = `The ${KINDS[kind].label} "${name}" named by the rig was not among the files.`;
  const assumed = kind === 'morph' ? 'later morphs move up by one' : 'opened without it';
  return withoutPlace('warning', 'part-not-given', message, rig, assumed);
}
