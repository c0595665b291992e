/**
 * The parts of a character: what is saved separately, each as its own file. A part keeps its id while edits replace its
 * content. Its revision identifies the content: undo restores an earlier revision, and none is ever reused. So a part
 * is unsaved if its revision differs from the saved one.
 *
 * A motion capture character has one `.bvh` per take, with skeleton and motion together, and points have a `.trc` per
 * take; every other character has its
 * skeleton in a `.skel` and its takes in `.anim` files, or, of Acclaim, in an `.asf` and `.amc` files.
 */

import { type FileKind, type PartContents, type PartKind, type SourceFile, sameName } from './files.ts';
import { SETS_EXTENSION } from './sets.ts';
import { savesAsAxisAngle } from './skeleton/axis-angle.ts';
import { LIMBS_EXTENSION } from './takes/limbs-file.ts';
import type { Take } from './takes/take.ts';

/** The file that a part was read from or saved as. */
export interface PartFile {
  /** Other than the part's own: it came in a file with other parts, and is saved as another file. */
  readonly kind: FileKind;
  readonly source: SourceFile;
  /**
   * The name of the part in that file. Parts are named after their file; under another name they belong to another
   * file.
   */
  readonly holds: string;
}

/** Facts about a part besides its content. */
export interface PartMark {
  /** Unique to this part. 0: not assigned yet; the store assigns it. */
  readonly id: number;
  /** Identifies its content. 0: not assigned yet. */
  readonly revision: number;
  /** Revision of a take without its markers, which are saved beside it; absent: `revision`. */
  readonly withoutMarkers?: number;
  readonly file?: PartFile;
}

/** The marks of a character's parts, in the order of its lists. */
export interface PartMarks {
  readonly skeleton?: PartMark;
  readonly skins: readonly PartMark[];
  readonly morphs: readonly PartMark[];
  readonly takes: readonly PartMark[];
  readonly poses?: PartMark;
  readonly sets?: PartMark;
  readonly limbs?: PartMark;
}

/** The fields of characters, and of their marks, that are a part each. */
export const SINGLE_PARTS = ['skeleton', 'poses', 'sets', 'limbs'] as const;

/** The mark of a part that the store has not numbered yet. */
export const UNMARKED: PartMark = { id: 0, revision: 0 };
/** The marks of a character without parts. */
export const NO_MARKS: PartMarks = { skins: [], morphs: [], takes: [] };

/** The mark of a part just read from a file: the same id if it is the same file with new content. */
export function readAs(before: PartMark | undefined, file: PartFile): PartMark {
  const isSame = before?.file?.source.path === file.source.path;
  return { id: isSame ? before.id : 0, revision: 0, file };
}

/** The revision of what is in a part's own file. */
export function ownRevision({ revision, withoutMarkers }: Pick<PartMark, 'revision' | 'withoutMarkers'>): number {
  return withoutMarkers ?? revision;
}

/** Applies a change to each mark, keeping their structure. */
export function mapMarks(parts: PartMarks, change: (mark: PartMark) => PartMark): PartMarks {
  const { skins, morphs, takes } = parts;
  const single = SINGLE_PARTS.flatMap((key) => {
    const mark = parts[key];
    return mark ? [[key, change(mark)] as const] : [];
  });
  return {
    ...Object.fromEntries(single),
    ...{ skins: skins.map(change), morphs: morphs.map(change), takes: takes.map(change) },
  };
}

interface PartOf<K extends PartKind> extends Omit<PartMark, 'file'> {
  readonly kind: K;
  /** Name of its file, without the extension. */
  readonly name: string;
  /** Its own file; absent if it was created here, came with other parts, or has been renamed. */
  readonly file?: SourceFile;
  /** The file it came from, which may be of another kind or hold it under another name. */
  readonly readFrom?: SourceFile;
  readonly content: PartContents[K];
}

/** One of a character's parts. */
export type Part = { [K in PartKind]: PartOf<K> }[PartKind];

/** A capture is a take with the skeleton that it was recorded on. */
const HOLDS: { readonly [K in PartKind]?: 'skeleton' | 'take' | 'capture' } = {
  skel: 'skeleton',
  asf: 'skeleton',
  anim: 'take',
  bvh: 'capture',
  amc: 'capture',
  trc: 'capture',
};

/** Whether parts of a kind are skeletons alone. */
export function isSkeletonKind(kind: PartKind): boolean {
  return HOLDS[kind] === 'skeleton';
}

/** Whether the file of a part of that kind may have any name: it says nothing about its content. */
export function isNamedApart(kind: PartKind): boolean {
  return kind === 'pose' || kind === 'sets' || kind === 'limbs';
}

/** Whether parts of a kind are takes, with or without their skeleton. */
export function isTakeKind(kind: PartKind): boolean {
  return HOLDS[kind] === 'take' || HOLDS[kind] === 'capture';
}

/** Whether a file of a kind is a take with its skeleton, in the file or beside it. */
export function isCaptureKind(kind: FileKind | undefined): boolean {
  const holds: { readonly [K in FileKind]?: string } = HOLDS;
  return kind !== undefined && holds[kind] === 'capture';
}

/** The take of a part; undefined if it has none. */
export function takeOf(part: Part): Take | undefined {
  if (part.kind === 'bvh' || part.kind === 'amc' || part.kind === 'trc') return part.content.take;
  return part.kind === 'anim' ? part.content : undefined;
}

/** `wasp_walk.anim`: the name of a part's file, existing or new. */
export function fileNameOf(part: Part): string {
  return part.file?.name ?? newFileName(part);
}

/** Where the extension is not the name of the kind. */
const EXTENSIONS: { readonly [K in PartKind]?: string } = { sets: SETS_EXTENSION, limbs: LIMBS_EXTENSION };

/** The axis-angle form may use its file's extension or its own. */
export function newFileName(part: Part): string {
  const name = `${part.name}.${EXTENSIONS[part.kind] ?? part.kind}`;
  if (part.kind !== 'skel' || !savesAsAxisAngle(part.content)) return name;
  return part.file && sameName(part.file.name, name) ? name : `${part.name}.axskel`;
}
