/** Results of reading: one model per file, whatever its format. */

import type { Dump } from './dump.ts';
import type { Limbs } from './limbs.ts';
import type { Morph } from './morph.ts';
import type { PoseByNames } from './pose-by-names.ts';
import type { PoseLibrary } from './poses.ts';
import type { Rig } from './rig.ts';
import type { Sets } from './sets.ts';
import type { SetsByName } from './sets-by-name.ts';
import type { Positions } from './skeleton/position-channels.ts';
import type { Skeleton } from './skeleton/skeleton.ts';
import type { Skin } from './skin.ts';
import type { FileSpace } from './space.ts';
import type { AttachFile } from './takes/attach-file.ts';
import type { LayersFile } from './takes/layers-file.ts';
import type { LimbsFile } from './takes/limbs-file.ts';
import type { Marker } from './takes/markers.ts';
import type { Take } from './takes/take.ts';

/** A file as provided: dropped, picked, fetched or read from disk. */
export interface SourceFile {
  /** Without folders: `wasp.skel`. */
  readonly name: string;
  /** With folders, `/` between them: `cse169/wasp.skel`. */
  readonly path: string;
  readonly bytes: number;
}

/** How messages name a file: by its name, or by its path where files of one name come from many folders. */
export type FileNaming = (source: SourceFile) => string;

/** Names a file without its folders: `walk.anim`. */
export const byFileName: FileNaming = ({ name }) => name;
/** Names a file with its folders, for files that share a name: `ada/walk.anim`. */
export const byPath: FileNaming = ({ path }) => path;

/** An image for a skin's material. The bytes are the file's own; the view decodes them. */
export interface Texture {
  readonly name: string;
  readonly mime: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/**
 * The kinds of content: what a file of it is read as, and, if characters keep it as a part that is saved on its own,
 * the content of that part. All other types of kinds derive from this list.
 */
interface Contents {
  readonly skel: { readonly file: { readonly skeletons: readonly Skeleton[] }; readonly part: Skeleton };
  readonly skin: { readonly file: { readonly skin: Skin }; readonly part: Skin };
  readonly morph: { readonly file: { readonly morph: Morph }; readonly part: Morph };
  readonly anim: { readonly file: { readonly take: Take }; readonly part: Take };
  readonly rig: { readonly file: { readonly rig: Rig } };
  readonly bvh: {
    readonly file: { readonly captures: readonly Capture[]; readonly guessed?: GuessedCapture };
    readonly part: Capture;
  };
  /** An Acclaim skeleton. */
  readonly asf: { readonly file: AcclaimSkeleton; readonly part: Skeleton };
  /** A motion of one, with the skeleton that it was read with. */
  readonly amc: { readonly file: AcclaimTake; readonly part: Capture };
  /** Points without bones, in a file that they are written to as well; of others they are whole characters. */
  readonly trc: { readonly file: PointsFile; readonly part: Capture };
  readonly pose: { readonly file: { readonly poses: readonly PoseByNames[] }; readonly part: PoseLibrary };
  /** Whole characters, with everything they need inside the file. */
  readonly character: { readonly file: { readonly characters: readonly WholeCharacter[] } };
  readonly texture: { readonly file: { readonly texture: Texture } };
  /** Labels of times of a take, which it is called after. */
  readonly markers: { readonly file: { readonly markers: readonly Marker[] } };
  /** Selection sets and locked DOFs of a character, beside its skeleton. */
  readonly sets: { readonly file: { readonly sets: SetsByName }; readonly part: SetsOf };
  /** Limbs of a character, beside its skeleton; goals of a take, which it is called after; or both. */
  readonly limbs: { readonly file: { readonly limbs: LimbsFile }; readonly part: LimbsOf };
  /** Layers of a take, which it is called after. */
  readonly layers: { readonly file: { readonly layers: LayersFile } };
  /** What the root follows in a take, which it is called after; see `AttachParsed`. */
  readonly attach: { readonly file: AttachParsed };
  /** Numbers of another program, to be compared with a character. */
  readonly dump: { readonly file: { readonly dump: Dump } };
}

/** The kind of content that a file can have: a key of `Contents`. */
export type FileKind = keyof Contents;

/** The result of reading a file of that kind. */
export type ContentOf<K extends FileKind> = { readonly [C in K]: { readonly kind: C } & Contents[C]['file'] }[K];
/** The content of a file of any kind, told by `kind`. */
export type FileContent = ContentOf<FileKind>;

/** Kinds of content that a character keeps as parts. */
export type PartKind = { [K in FileKind]: Contents[K] extends { readonly part: unknown } ? K : never }[FileKind];

/** The content of each kind of part. */
export type PartContents = { readonly [K in PartKind]: Contents[K]['part'] };

/** Sets and locks with the skeleton whose joints they name. */
export interface SetsOf {
  readonly skeleton: Skeleton;
  readonly sets: Sets;
}

/** Limbs with the skeleton whose joints they name. */
export interface LimbsOf {
  readonly skeleton: Skeleton;
  readonly limbs: Limbs;
}

/** Attachments of a take, with what holds while a character that it follows is not open: all of one file. */
export interface AttachParsed {
  readonly attach: AttachFile;
  /** The plain file beside it. */
  readonly plain?: Take;
  /** The take that is attached, while a plain one is in its place. */
  readonly waiting?: { readonly whole: Take; readonly plain: Take };
}

/** An Acclaim skeleton with the unit that it states, or that was guessed. */
export interface AcclaimSkeleton {
  readonly skeleton: Skeleton;
  readonly space?: FileSpace;
}

/** A motion of an Acclaim skeleton. */
export interface AcclaimTake extends AcclaimSkeleton {
  readonly take: Take;
  /** The file of the skeleton; absent of content that is to be written. */
  readonly of?: SourceFile;
}

/** Points over time. */
export interface PointsFile {
  readonly capture: Capture;
  readonly space?: FileSpace;
}

/** Facts that a motion capture file doesn't state, the same for all of its captures. */
export interface GuessedCapture extends FileSpace {
  /** The meaning of position channels; the characters still have that of the format. */
  readonly positions: Positions;
}

/** One `ROOT` of a motion capture file: a skeleton and its motion; no take if the file has no frames. */
export interface Capture {
  readonly skeleton: Skeleton;
  readonly take?: Take;
}

/** A character that one file contains whole. Each part has its own name; skins name their textures by name. */
export interface WholeCharacter {
  readonly skeleton: Skeleton;
  /** Alternatives: the first is shown. */
  readonly skins: readonly Skin[];
  readonly morphs: readonly Morph[];
  /** Takes: the first is shown. */
  readonly takes: readonly Take[];
  readonly textures: readonly Texture[];
  /** Absent of text formats, whose units are anyone's. */
  readonly space?: FileSpace;
  /** False if its limits are told, but takes may exceed them. */
  readonly clampsToLimits?: false;
}

/** A file that was read without an error. */
export type ParsedFile = FileContent & {
  readonly source: SourceFile;
  /** Other files that are in it: buffers and textures, the parts of a take with layers. */
  readonly beside?: readonly SourceFile[];
  /** Of its bytes, as 64 hex digits; only where a file beside it says with which bytes it was saved. */
  readonly sha256?: string;
  /** A take with layers that were kept although its plain file was edited: reading the same files again gives another. */
  readonly isJoinedByChoice?: true;
};

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
