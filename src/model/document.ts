/**
 * The document: everything that is saved and undone. Plain immutable data; parts that did not change keep their
 * identity from one document to the next, which is how the view knows what to rebuild.
 */
import type { Vec3 } from '../math/vec3.ts';
import type { ChannelClip } from './clip.ts';
import type { ParsedFile, SourceFile, Texture } from './files.ts';
import type { IkSetup } from './ik.ts';
import { isOfBvh } from './joint-types.ts';
import type { Morph } from './morph.ts';
import type { PartMarks } from './part.ts';
import type { NamedPose } from './poses.ts';
import type { JointPair, RetargetOptions } from './retarget.ts';
import type { Skeleton } from './skeleton.ts';
import type { Skin } from './skin.ts';

export interface Document {
  readonly characters: readonly Character[];
  /** Read without an error, but belonging to nothing here. */
  readonly unused: readonly UnusedFile[];
  /** The opening sample stands until the first file is opened. */
  readonly isOpeningSample: boolean;
  /** How many characters were ever made here: the next one's id, and no other's again. */
  readonly charactersMade: number;
}

/** A skeleton, a skin, or both, with what moves them. A skin or a clip alone is one too, and waits for a skeleton. */
export interface Character {
  /** Unique in the document, and kept over edits and undo. */
  readonly id: string;
  readonly name: string;
  readonly skeleton?: Skeleton;
  /** Alternatives: `shownSkin` is drawn. */
  readonly skins: readonly Skin[];
  readonly shownSkin: number;
  readonly morphs: readonly Morph[];
  readonly textures: readonly Texture[];
  /** Takes: `shownClip` is played; -1 for none. */
  readonly clips: readonly ChannelClip[];
  readonly shownClip: number;
  /** One value for each of the character's DOFs (see `dofs.ts`), as set: what no channel drives stands so. */
  readonly pose: readonly number[];
  /** DOFs set by hand over the clip at one moment; gone when time moves on. */
  readonly unkeyed?: Unkeyed;
  readonly clampsToLimits: boolean;
  /** Where it stands; more than one shows it several times over the same data. At least one. */
  readonly placements: readonly Placement[];
  /** Added to the time of the transport. */
  readonly timeOffsetSeconds: number;
  /** How its own space lies in the scene; absent: as it is. */
  readonly space?: Space;
  /** Not drawn; it plays on unseen. */
  readonly isHidden?: boolean;
  /** A take of another character that moves its joints, instead of its own. */
  readonly driver?: Driver;
  /** What inverse kinematics holds on to; absent: as `defaultIk` says. */
  readonly ik?: IkSetup;
  /** The library of poses; absent rather than empty. */
  readonly poses?: readonly NamedPose[];
  /** The files it came from. */
  readonly sources: readonly SourceFile[];
  /** Which part is which (`part.ts`). Commands leave it alone: the store keeps it up with the parts themselves. */
  readonly parts?: PartMarks;
}

/**
 * A take of another character that moves this one's joints: put onto it, live.
 *
 * What it needs of the other one is held here and shared with it, so that a pose remains a matter of one character. The
 * store keeps it in step (`edit/drivers.ts`): when the other character changes, so does this. When it goes, what it last
 * did stays.
 */
export interface Driver {
  /** Id of the character whose take it is. */
  readonly sourceId: string;
  readonly source: DriverSource;
  /** In the order of this character's joints, each at most once. */
  readonly pairs: readonly JointPair[];
  readonly options: RetargetOptions;
}

/** What of a character moves another one. */
export interface DriverSource {
  readonly name: string;
  readonly skeleton: Skeleton;
  readonly clip: ChannelClip;
  readonly pose: readonly number[];
  readonly clampsToLimits: boolean;
  readonly timeOffsetSeconds: number;
  readonly space?: Space;
}

export interface Unkeyed {
  readonly timeSeconds: number;
  /** Indices of DOFs (see `dofs.ts`), ascending. */
  readonly dofs: readonly number[];
  /** One for each of `dofs`. The pose knows nothing of them: they go without a trace. */
  readonly values: readonly number[];
}

export interface Placement {
  readonly position: Vec3;
  /** Radians about x, then y, then z. */
  readonly turn: Vec3;
  readonly scale: number;
}

/** From a character's own space to one whose up is y and whose unit is the metre, before its placement. */
export interface Space {
  readonly up: 'y' | 'z';
  readonly unit: LengthUnit;
  /** Metres that 1 stands for where the unit is its `own`; above 0. */
  readonly metres?: number;
  /** How far it is lifted onto the ground; metres, or units of the file where it is taken as it is. */
  readonly lift: number;
}

/**
 * The length that 1 in a file stands for; `asIs`: taken for a metre, whatever it is. `cmu`: 1/0.45 of an inch, as the
 * motion capture of Carnegie Mellon University has it. `own`: any other, named beside it.
 */
export const LENGTH_UNITS = [
  'asIs',
  'metres',
  'decimetres',
  'centimetres',
  'millimetres',
  'inches',
  'cmu',
  'own',
] as const;
export type LengthUnit = (typeof LENGTH_UNITS)[number];

export const DEFAULT_SPACE: Space = { up: 'y', unit: 'asIs', lift: 0 };

/** Kept with its content: the next files opened may be what it waits for. */
export interface UnusedFile {
  readonly file: ParsedFile;
  readonly why: string;
}

export const EMPTY_DOCUMENT: Document = {
  characters: [],
  unused: [],
  isOpeningSample: false,
  charactersMade: 0,
};
export const DEFAULT_PLACEMENT: Placement = { position: [0, 0, 0], turn: [0, 0, 0], scale: 1 };

export function shownSkin(character: Character): Skin | undefined {
  return character.skins[character.shownSkin];
}

export function shownClip(character: Character): ChannelClip | undefined {
  return character.clips[character.shownClip];
}

/** Whether a character is a figure of BVH as it stands: what is kept of it is what its file holds. */
export function isBvh({ skeleton }: Pick<Character, 'skeleton'>): boolean {
  return skeleton?.joints.every(({ motion }) => isOfBvh(motion)) ?? false;
}

export function findCharacter(document: Document, id: string | undefined): Character | undefined {
  return document.characters.find((c) => c.id === id);
}

/**
 * Characters that play something to be seen; all that play, where everything is hidden: their time is the transport's.
 */
export function playingCharacters(document: Document): readonly Character[] {
  const playing = document.characters.filter((c) => c.driver ?? shownClip(c));
  const seen = playing.filter((c) => !c.isHidden);
  return seen.length ? seen : playing;
}

/** Second of the transport at which the first moment of what a character plays comes; without a clip, its second 0. */
export function startSeconds(character: Character): number {
  const source = character.driver?.source;
  const clip = source?.clip ?? shownClip(character);
  return (clip?.range[0] ?? 0) - character.timeOffsetSeconds - (source?.timeOffsetSeconds ?? 0) + 0;
}

/** Seconds of the transport from the first moment of any clip that plays to the last; undefined without clips. */
export function rangeOfClips(document: Document): readonly [number, number] | undefined {
  let start = Number.POSITIVE_INFINITY;
  let end = Number.NEGATIVE_INFINITY;
  for (const character of playingCharacters(document)) {
    const source = character.driver?.source;
    const clip = source?.clip ?? shownClip(character);
    if (!clip) continue;
    const offset = character.timeOffsetSeconds + (source?.timeOffsetSeconds ?? 0);
    start = Math.min(start, clip.range[0] - offset);
    end = Math.max(end, clip.range[1] - offset);
  }
  return start <= end ? [start, end] : undefined;
}
