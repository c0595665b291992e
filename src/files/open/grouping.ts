/**
 * Decides which of the files opened together belong to each other:
 *
 * 1. a `.rig` binds the files that it names, looked up by base name (its own folder first);
 * 2. any other skin, morph or anim belongs to the skeleton in the same folder whose stem is the longest prefix of its
 * own (`wasp_walk.anim` → `wasp.skel`), else to the one in the closest folder around it that is called like it
 * (`skins/wasp.skin` → `skeletons/wasp.skel`), or to the only skeleton; an anim to the only character of another kind,
 * too;
 * 3. the rest has no skeleton here; `open-in-steps.ts` assigns it to characters of the document.
 *
 * Files with errors take part, so that what depends on them is known.
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
import { skeletonNameFor } from '../acclaim-names.ts';
import { type FormatKind, formatKindOf, KINDS, openingOf, type Role, skeletonKindFor } from '../kinds.ts';
import { partOpening } from './contents.ts';

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

/** Which files belong together, before anything is opened. */
export interface Grouping {
  readonly groups: readonly FileGroup[];
  /** By role: what belongs to no skeleton among the files. */
  readonly loose: Readonly<Record<LooseRole, readonly ReadFile[]>>;
  /** Rigs with errors, or none of whose files was given. */
  readonly idleRigs: readonly ReadFile[];
  readonly diagnostics: readonly Diagnostic[];
}

/** Whether a file has errors, so that it has no content. */
export function isBroken(file: ReadFile): file is BrokenFile & { readonly broken: true } {
  return 'broken' in file;
}

/** Whether a file was read without errors. */
export function isRead(file: ReadFile): file is ParsedFile {
  return !isBroken(file);
}

/**
 * Groups files by skeleton, by the rules at the top of this file.
 * @param called how messages name a file
 */
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
  const loose: Record<LooseRole, ReadFile[]> = { part: [], beside: [], layers: [], poses: [], texture: [], dump: [] };
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

/** Skeletons of a folder, or all, by their stems: there may be thousands, of as many parts. */
export class ByStem<T> {
  private readonly items = new Map<string, T>();
  /** Stems of several. */
  private readonly shared = new Set<string>();
  private earliest: T | undefined;
  private count = 0;

  /**
   * Adds an entry by the stem of its file.
   * @param source its file
   */
  add(item: T, source: SourceFile): void {
    const stem = stemOf(source).toLowerCase();
    this.earliest ??= item;
    this.count++;
    if (this.items.has(stem)) this.shared.add(stem);
    else this.items.set(stem, item);
  }

  /** The one with the longest stem that begins the file's. */
  named(source: SourceFile): T | undefined {
    const stem = stemOf(source).toLowerCase();
    for (let length = stem.length; length > 0; length--) {
      const item = this.items.get(stem.slice(0, length));
      if (item) return item;
    }
    return undefined;
  }

  /** The same, of whole words of its name, and if no other has that stem. */
  called(source: SourceFile): T | undefined {
    const stem = stemOf(source).toLowerCase();
    for (let length = stem.length; length > 0; length--) {
      const item = this.items.get(stem.slice(0, length));
      const isWhole = !/^\p{L}/u.test(stem.slice(length));
      if (item && isWhole) return this.shared.has(stem.slice(0, length)) ? undefined : item;
    }
    return undefined;
  }

  /** The entry that was added first. */
  get first(): T | undefined {
    return this.earliest;
  }

  /** The only entry; undefined if there are none or several. */
  get only(): T | undefined {
    return this.count === 1 ? this.earliest : undefined;
  }
}

/** Finds the group of a part. */
function skeletonsFor<G extends FileGroup>(groups: readonly G[]): (part: ReadFile) => G | undefined {
  const [made, any] = [new InFolders<G>(), new InFolders<G>()];
  for (const group of groups) {
    if (!group.skeleton) continue;
    any.add(group, group.skeleton.source);
    if (takesParts(group.skeleton)) made.add(group, group.skeleton.source);
  }
  return (part) => {
    const { kind, source } = part;
    const opening = openingOf(kind);
    if (opening.as === 'part' && opening.skeletonFile) {
      const own = skeletonFileOf(part, groups);
      return groups.find(({ skeleton }) => own !== undefined && skeleton?.source.path === own.path);
    }
    const places = opening.as === 'part' && opening.onAny ? [made, any] : [made];
    const near = places.flatMap((all) => all.in(source) ?? []);
    const own = firstOf(near, (all) => all.named(source) ?? all.only);
    if (own) return own;
    const around = foldersAround(source).flatMap((folder) => places.flatMap((all) => all.below(folder) ?? []));
    const found = firstOf(around, (all) => all.called(source));
    // None in its own folder: the only one given.
    return found ?? (near.length > 0 ? undefined : firstOf(places, ({ everywhere }) => everywhere.only));
  };
}

/** The file of the skeleton that a part comes with; of one that was not read, by the names of both. */
function skeletonFileOf(part: ReadFile, groups: readonly FileGroup[]): SourceFile | undefined {
  if (isRead(part)) return partOpening(part)?.skeletonFile?.(part);
  const near = groups.flatMap(({ skeleton }) =>
    skeleton && folderOf(skeleton.source) === folderOf(part.source) ? [skeleton.source] : [],
  );
  const given = near.filter(({ name }) => formatKindOf(name) === skeletonKindFor(part.source.name));
  const name = skeletonNameFor(
    part.source.name,
    given.map((source) => source.name),
  );
  return given.find((source) => source.name === name);
}

function firstOf<T, R>(list: readonly T[], find: (item: T) => R | undefined): R | undefined {
  for (const item of list) {
    const found = find(item);
    if (found !== undefined) return found;
  }
  return undefined;
}

/** The folders around the one of a file, the closest first, up to that of the whole drop. */
function foldersAround(source: SourceFile): readonly string[] {
  const parts = folderOf(source).split('/');
  return parts.map((_, i) => parts.slice(0, parts.length - 1 - i).join('/'));
}

class InFolders<T> {
  readonly everywhere = new ByStem<T>();
  private readonly folders = new Map<string, ByStem<T>>();
  /** Those in a folder and all folders in it. */
  private readonly trees = new Map<string, ByStem<T>>();

  add(item: T, source: SourceFile): void {
    placeIn(this.folders, folderOf(source)).add(item, source);
    for (const folder of foldersAround(source)) placeIn(this.trees, folder).add(item, source);
    this.everywhere.add(item, source);
  }

  /** Those in the folders of a folder; undefined if there are none. */
  below(folder: string): ByStem<T> | undefined {
    return this.trees.get(folder);
  }

  /** Those in the folder of a file; undefined if it has none. */
  in(source: SourceFile): ByStem<T> | undefined {
    return this.folders.get(folderOf(source));
  }
}

function placeIn<T>(places: Map<string, ByStem<T>>, folder: string): ByStem<T> {
  const place = places.get(folder) ?? new ByStem<T>();
  places.set(folder, place);
  return place;
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
  return { ...withoutPlace('warning', 'part-not-given', message, rig, assumed), missing: baseName(name) };
}
