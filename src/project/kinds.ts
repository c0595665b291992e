/**
 * All kinds of text files. A record holds the names of a kind and which characters have content for it. Readers are in
 * `open/readers.ts`, writers in `save/writers.ts`, each with an entry per kind: the page's first script includes
 * neither, since it reads in a worker and loads the writers when something is saved.
 */
import { axisAngleObstacle, savesAsAxisAngle } from '../model/axis-angle.ts';
import { type Character, isBvh, shownClip, shownSkin } from '../model/document.ts';
import type { FileKind } from '../model/files.ts';

/** What a text file can contain: everything but images. */
export type TextKind = Exclude<FileKind, 'texture'>;

export interface Kind {
  /** Without the dot, in lower case; the first is used for writing. */
  readonly extensions: readonly [string, ...string[]];
  /** For users: "skeleton". */
  readonly label: string;
  /** Label in the save menu. */
  readonly saveLabel: string;
  /** The kind of content that it is read as and written from. */
  readonly content: TextKind;
  /** Whether a character has anything to save in this kind of file. */
  has(character: Character): boolean;
  /** Why a character can't be saved in it although it has the content; a sentence. */
  whyNot?(character: Character): string | undefined;
  /** Whether this is a character's native format; otherwise it is converted, and saving marks nothing as saved. */
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
  // Readers recognise the axis-angle form by content, whatever the extension; saving depends on the extension.
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

/**
 * A kind of file that a character can be opened from and saved as: `skel` is the hierarchy form, `axskel` the
 * axis-angle form.
 */
export type FormatKind = keyof typeof KINDS;

/** In the order of the menus. */
export const FORMAT_KINDS = Object.keys(KINDS) as readonly FormatKind[];

/** Without dots. */
export const READABLE_EXTENSIONS: readonly string[] = FORMAT_KINDS.flatMap((kind) => KINDS[kind].extensions);

/** The kind of a file by its extension, in any case; undefined for other files. */
export function formatKindOf(fileName: string): FormatKind | undefined {
  const dot = fileName.lastIndexOf('.');
  const extension = dot < 0 ? '' : fileName.slice(dot + 1).toLowerCase();
  return FORMAT_KINDS.find((kind) => KINDS[kind].extensions.some((own) => own === extension));
}
