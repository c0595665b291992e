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

  for (const file of files) {
    if (file.kind !== 'rig') continue;
    if (isBroken(file)) {
      idleRigs.push(file);
      continue;
    }
    const { rig } = file;
    const find = (kind: FileKind & FormatKind, name: string | undefined) => {
      if (name === undefined) return undefined;
      const found = lookUp(files, file, kind, name);
      if (!found) diagnostics.push(partNotGiven(called(file.source), kind, name));
      return found;
    };
    const skeleton = find('skel', rig.skeleton);
    const named = [
      find('skin', rig.skin),
      ...rig.morphs.map((morph) => find('morph', morph)),
      find('anim', rig.animation),
    ];
    const parts = named.filter((part) => part !== undefined);
    if (!skeleton && parts.length === 0) {
      idleRigs.push(file);
      continue;
    }
    const shared = skeleton && groups.find((g) => g.skeleton === skeleton);
    if (shared) {
      // Two rigs with the same skeleton: the second's skin and animation are alternatives.
      shared.parts.push(...parts.filter((part) => !shared.parts.includes(part)));
      shared.rigs.push(file);
    } else groups.push({ name: rig.name, ...(skeleton && { skeleton }), parts, rigs: [file] });
    for (const part of [skeleton, ...parts]) if (part) taken.add(part);
  }

  for (const file of files) {
    if (isSkeleton(file) && !taken.has(file)) groups.push({ skeleton: file, parts: [], rigs: [] });
  }

  // Poses are matched to characters by their joints, images by the names in skins.
  const loose: Record<LooseRole, ReadFile[]> = { part: [], markers: [], poses: [], texture: [], dump: [] };
  for (const file of files) {
    const { as } = openingOf(file.kind);
    if (as === 'characters' || as === 'rig' || taken.has(file)) continue;
    const group = as === 'part' ? skeletonFor(file, groups) : undefined;
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

function skeletonFor(part: ReadFile, groups: readonly FileGroup[]): FileGroup | undefined {
  const folder = folderOf(part.source);
  const skeletons = groups.filter((g) => g.skeleton && takesParts(g.skeleton));
  const there = skeletons.filter((g) => g.skeleton && folderOf(g.skeleton.source) === folder);
  let best: FileGroup | undefined;
  let length = 0;
  for (const group of there) {
    if (!group.skeleton) continue;
    const fit = prefixFit(stemOf(group.skeleton.source), stemOf(part.source));
    if (fit > length) {
      best = group;
      length = fit;
    }
  }
  if (best) return best;
  if (there.length > 0) return there.length === 1 ? there[0] : undefined;
  // None in its own folder: use the only skeleton given.
  return skeletons.length === 1 ? skeletons[0] : undefined;
}

/** By base name, ignoring folders in the `.rig`; files in the rig's own folder take precedence. */
function lookUp(files: readonly ReadFile[], rig: ReadFile, kind: ReadFile['kind'], name: string) {
  const base = baseName(name);
  const fits = files.filter((f) => f.kind === kind && sameName(f.source.name, base));
  return fits.find((f) => folderOf(f.source) === folderOf(rig.source)) ?? fits[0];
}

function partNotGiven(rig: string, kind: FormatKind, name: string): Diagnostic {
  const message = `The ${KINDS[kind].label} "${name}" named by the rig was not among the files.`;
  const assumed = kind === 'morph' ? 'later morphs move up by one' : 'opened without it';
  return withoutPlace('warning', 'part-not-given', message, rig, assumed);
}
