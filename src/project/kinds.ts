/**
 * The one list of the kinds of text files. A record says what page and command call a kind, and who has something of it.
 * What reads them is in `open/readers.ts`, what writes them in `save/writers.ts`, each with an entry for every kind: the
 * page's first script carries neither, for it reads in its worker and fetches what writes when something is saved.
 */
import { axisAngleObstacle, savesAsAxisAngle } from '../model/axis-angle.ts';
import { type Character, isBvh, shownClip, shownSkin } from '../model/document.ts';
import type { FileKind } from '../model/files.ts';

/** What a text file can hold: all but pictures. */
export type TextKind = Exclude<FileKind, 'texture'>;

export interface Kind {
  /** Without the dot, lower case; the first one is written. */
  readonly extensions: readonly [string, ...string[]];
  /** As a person would say it: "skeleton". */
  readonly label: string;
  /** In the menu of what can be saved. */
  readonly saveLabel: string;
  /** What a file of it becomes, and what it is made of. */
  readonly content: TextKind;
  /** Whether a character has anything to save as such a file. */
  has(character: Character): boolean;
  /** What keeps a character from being saved as one although it has what the file would hold; a sentence. */
  whyNot?(character: Character): string | undefined;
  /** Whether that is what a character's own file is; otherwise it is converted, and nothing counts as saved by it. */
  isOwn(character: Character): boolean;
}

const hasSkeleton = ({ skeleton }: Character) => skeleton !== undefined;
const isAxisAngle = ({ skeleton }: Character) => skeleton !== undefined && savesAsAxisAngle(skeleton);
const isAnyones = () => true;

export const KINDS = {
  skel: {
    extensions: ['skel'],
    label: 'skeleton',
    saveLabel: 'Skeleton (.skel)',
    content: 'skel',
    has: hasSkeleton,
    isOwn: (c) => !hasSkeleton(c) || !(isBvh(c) || isAxisAngle(c)),
  },
  // Reading tells the axis-angle form by what is in a file, which may be called either; saving goes by the ending.
  axskel: {
    extensions: ['axskel'],
    label: 'skeleton',
    saveLabel: 'Axis-angle skeleton (.axskel)',
    content: 'skel',
    has: ({ skeleton }) => skeleton !== undefined && axisAngleObstacle(skeleton) === undefined,
    whyNot: ({ skeleton }) => skeleton && axisAngleObstacle(skeleton),
    isOwn: (c) => !hasSkeleton(c) || isAxisAngle(c),
  },
  skin: {
    extensions: ['skin'],
    label: 'skin',
    saveLabel: 'Skin (.skin)',
    content: 'skin',
    has: (c) => shownSkin(c) !== undefined,
    isOwn: isAnyones,
  },
  morph: {
    extensions: ['morph'],
    label: 'morph',
    saveLabel: 'Morphs (.morph)',
    content: 'morph',
    has: ({ morphs }) => morphs.length > 0,
    isOwn: isAnyones,
  },
  anim: {
    extensions: ['anim'],
    label: 'animation',
    saveLabel: 'Animation (.anim)',
    content: 'anim',
    has: (c) => shownClip(c) !== undefined,
    isOwn: (c) => !isBvh(c),
  },
  rig: {
    extensions: ['rig'],
    label: 'rig',
    saveLabel: 'Rig (.rig)',
    content: 'rig',
    has: (c) => hasSkeleton(c) || shownSkin(c) !== undefined,
    isOwn: isAnyones,
  },
  bvh: {
    extensions: ['bvh'],
    label: 'motion capture',
    saveLabel: 'Motion capture (.bvh)',
    content: 'bvh',
    has: hasSkeleton,
    isOwn: (c) => !hasSkeleton(c) || isBvh(c),
  },
  pose: {
    extensions: ['pose'],
    label: 'poses',
    saveLabel: 'Poses (.pose)',
    content: 'pose',
    has: ({ poses }) => (poses?.length ?? 0) > 0,
    isOwn: isAnyones,
  },
} as const satisfies Readonly<Record<TextKind | 'axskel', Kind>>;

/** A kind of file, as which a character can be opened and saved: `skel` is the hierarchy form, `axskel` the other. */
export type FormatKind = keyof typeof KINDS;

/** All of them, in the order of the menus. */
export const FORMAT_KINDS = Object.keys(KINDS) as readonly FormatKind[];

/** Without dots. */
export const READABLE_EXTENSIONS: readonly string[] = FORMAT_KINDS.flatMap((kind) => KINDS[kind].extensions);

/** The kind that a file's name tells, in any case; undefined for a file that is no text of ours. */
export function formatKindOf(fileName: string): FormatKind | undefined {
  const dot = fileName.lastIndexOf('.');
  const extension = dot < 0 ? '' : fileName.slice(dot + 1).toLowerCase();
  return FORMAT_KINDS.find((kind) => KINDS[kind].extensions.some((own) => own === extension));
}
