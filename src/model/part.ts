/**
 * The parts that a character is made of: what is saved by itself, each as a file of its own. A part keeps its id while
 * its content is replaced by edits, and has a revision that tells one content from another: undo brings an earlier
 * revision back, and none is ever used twice. So a part is unsaved where its revision is not the one that was saved.
 *
 * A figure of motion capture is a `.bvh` a take, with skeleton and motion in one; every other character has its skeleton
 * in a `.skel` and its takes in `.anim`s.
 */
import { savesAsAxisAngle } from './axis-angle.ts';
import type { ChannelClip } from './clip.ts';
import { type CapturedFigure, type SourceFile, sameName } from './files.ts';
import type { Morph } from './morph.ts';
import type { NamedPose } from './poses.ts';
import type { Skeleton } from './skeleton.ts';
import type { Skin } from './skin.ts';

/** What each kind of part holds. */
export interface PartContents {
  readonly skel: Skeleton;
  readonly skin: Skin;
  readonly morph: Morph;
  readonly anim: ChannelClip;
  readonly bvh: CapturedFigure;
  readonly pose: PoseLibrary;
}

/** Kinds of files whose content can be changed here. */
export type PartKind = keyof PartContents;

/** A character's library of poses, by the names of what they are of. */
export interface PoseLibrary {
  readonly skeleton?: Skeleton;
  readonly morphs: readonly Morph[];
  readonly poses: readonly NamedPose[];
}

/** The file that a part was read from or saved as. */
export interface PartFile {
  readonly kind: PartKind;
  readonly source: SourceFile;
  /** What the part is called in it: a part is called after its file, and under another name it is another file's. */
  readonly holds: string;
}

/** What is known of a part beside its content. */
export interface PartMark {
  /** Of this part and no other. 0: not numbered yet, which the store does. */
  readonly id: number;
  /** Of its content. 0: not numbered yet. */
  readonly revision: number;
  readonly file?: PartFile;
}

/** The marks of a character's parts, in the order of its own lists. */
export interface PartMarks {
  readonly skeleton?: PartMark;
  readonly skins: readonly PartMark[];
  readonly morphs: readonly PartMark[];
  readonly clips: readonly PartMark[];
  readonly poses?: PartMark;
}

export const UNMARKED: PartMark = { id: 0, revision: 0 };
export const NO_MARKS: PartMarks = { skins: [], morphs: [], clips: [] };

/** The mark of a part that was read from a file: the same part where it is the same file, with other content. */
export function readAs(before: PartMark | undefined, file: PartFile): PartMark {
  const isSame = before?.file?.source.path === file.source.path;
  return { id: isSame ? before.id : 0, revision: 0, file };
}

/** Marks that lie as those do. */
export function mapMarks(parts: PartMarks, change: (mark: PartMark) => PartMark): PartMarks {
  const { skeleton, skins, morphs, clips, poses } = parts;
  return {
    ...(skeleton && { skeleton: change(skeleton) }),
    skins: skins.map(change),
    morphs: morphs.map(change),
    clips: clips.map(change),
    ...(poses && { poses: change(poses) }),
  };
}

interface PartOf<K extends PartKind> extends Omit<PartMark, 'file'> {
  readonly kind: K;
  /** What its file is called, without the ending. */
  readonly name: string;
  /** Its own; absent where it was made here, or is called differently now. */
  readonly file?: SourceFile;
  readonly content: PartContents[K];
}

/** One of a character's parts. */
export type Part = { [K in PartKind]: PartOf<K> }[PartKind];

/** `wasp_walk.anim`: as a part's file is called, or would be. */
export function fileNameOf(part: Part): string {
  return part.file?.name ?? newFileName(part);
}

/** The axis-angle form may be called either: as its file is, or by its own ending. */
export function newFileName(part: Part): string {
  const name = `${part.name}.${part.kind}`;
  if (part.kind !== 'skel' || !savesAsAxisAngle(part.content)) return name;
  return part.file && sameName(part.file.name, name) ? name : `${part.name}.axskel`;
}
