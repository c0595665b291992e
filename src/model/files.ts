/** Results of reading: one model per file, whatever its format. */
import type { ChannelClip } from './clip.ts';
import type { Morph } from './morph.ts';
import type { PoseByNames } from './pose-by-names.ts';
import type { Rig } from './rig.ts';
import type { Skeleton } from './skeleton.ts';
import type { Skin } from './skin.ts';

/** A file as provided: dropped, picked, fetched or read from disk. */
export interface SourceFile {
  /** Without folders: `wasp.skel`. */
  readonly name: string;
  /** With folders, `/` between them: `cse169/wasp.skel`. */
  readonly path: string;
  readonly bytes: number;
}

/** An image for a skin's material. The bytes are the file's own; the view decodes them. */
export interface Texture {
  readonly name: string;
  readonly mime: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

export type FileContent =
  | { readonly kind: 'skel'; readonly skeletons: readonly Skeleton[] }
  | { readonly kind: 'skin'; readonly skin: Skin }
  | { readonly kind: 'morph'; readonly morph: Morph }
  | { readonly kind: 'anim'; readonly clip: ChannelClip }
  | { readonly kind: 'rig'; readonly rig: Rig }
  | { readonly kind: 'bvh'; readonly figures: readonly CapturedFigure[] }
  | { readonly kind: 'pose'; readonly poses: readonly PoseByNames[] }
  | { readonly kind: 'texture'; readonly texture: Texture };

/** One `ROOT` of a motion capture file: a skeleton and its motion; no clip if the file has no frames. */
export interface CapturedFigure {
  readonly skeleton: Skeleton;
  readonly clip?: ChannelClip;
}

export type FileKind = FileContent['kind'];

/** A file that was read without an error. */
export type ParsedFile = FileContent & { readonly source: SourceFile };

/**
 * A file with errors: it still helps to decide which files belong together, and keeps its group from opening in part.
 */
export interface BrokenFile {
  readonly kind: FileKind;
  readonly source: SourceFile;
}

/** The file name without folders, for either kind of slash. */
export function baseName(name: string): string {
  return name.slice(Math.max(name.lastIndexOf('/'), name.lastIndexOf('\\')) + 1);
}

/** `cse169/wasp_walk.anim` → `wasp_walk`. */
export function stemOf(source: SourceFile): string {
  const dot = source.name.lastIndexOf('.');
  return dot > 0 ? source.name.slice(0, dot) : source.name;
}

/** `cse169/wasp.skel` → `cse169`; empty without a folder. */
export function folderOf(source: SourceFile): string {
  const slash = source.path.lastIndexOf('/');
  return slash < 0 ? '' : source.path.slice(0, slash);
}

/** Ignores case: file systems differ, and `.rig` files come from all of them. */
export function sameName(a: string, b: string): boolean {
  return a.toLowerCase() === b.toLowerCase();
}
