/**
 * The document: everything that is saved and undone. Plain immutable data; unchanged parts keep their identity from one
 * document to the next, which tells the view what to rebuild.
 */
import type { Vec3 } from '../math/vec3.ts';
import type { ParsedFile, SourceFile, Texture } from './files.ts';
import type { IkSetup } from './ik.ts';
import type { JointType } from './joint-types/type.ts';
import type { Limbs } from './limbs.ts';
import type { Morph } from './morph.ts';
import type { PartMarks } from './part.ts';
import { perObject } from './per-object.ts';
import type { NamedPose } from './poses.ts';
import type { Sets } from './sets.ts';
import { jointTypeOf } from './skeleton/joint-types.ts';
import type { Skeleton } from './skeleton/skeleton.ts';
import type { Skin } from './skin.ts';
import type { Space } from './space.ts';
import type { JointPair, RetargetOptions } from './takes/retarget.ts';
import type { ReviewedTake } from './takes/review.ts';
import type { Take } from './takes/take.ts';

/**
 * Everything that is saved and undone: characters in the order of the outliner, files kept for later, reviewed takes.
 */
export interface Document {
  readonly characters: readonly Character[];
  /** Files read without errors that belong to nothing in the document yet. */
  readonly unused: readonly UnusedFile[];
  /**
   * Whether the document still shows the example loaded at start, which the first opened file replaces unless something
   * to be saved was changed in it.
   */
  readonly isOpeningSample: boolean | 'changed';
  /** Number of characters ever created; used for new ids, so that no id is reused. */
  readonly charactersMade: number;
  /** Takes that are reviewed, in the order of the list; their files are not part of the document. */
  readonly review?: readonly ReviewedTake[];
}

/**
 * A skeleton, skins or both, with their animation. A skin or a take alone is also a character, waiting for its
 * skeleton.
 */
export interface Character {
  /** Unique in the document; kept across edits and undo. */
  readonly id: string;
  readonly name: string;
  readonly skeleton?: Skeleton;
  /** Alternatives; `shownSkin` is drawn. */
  readonly skins: readonly Skin[];
  readonly shownSkin: number;
  readonly morphs: readonly Morph[];
  readonly textures: readonly Texture[];
  /** Takes; `shownTake` plays; -1 for none. */
  readonly takes: readonly Take[];
  readonly shownTake: number;
  /** One value per DOF of the character (see `dofs.ts`), as set; used for DOFs that no channel drives. */
  readonly pose: readonly number[];
  /** DOFs set by hand over the take at one time; discarded when the time changes. */
  readonly unkeyed?: Unkeyed;
  readonly clampsToLimits: boolean;
  /** Instances of the character in the scene, all sharing its data. At least one. */
  readonly placements: readonly Placement[];
  /** Seconds added to the transport's time. */
  readonly timeOffsetSeconds: number;
  /** How the character's own space maps to the scene; absent: identity. */
  readonly space?: Space;
  /** Not drawn; it keeps playing. */
  readonly isHidden?: boolean;
  /** A take of another character that drives its joints instead of its own take (retargeting). */
  readonly driver?: Driver;
  /**
   * Those whose joints its takes follow (`Take.attached`), with only what moves them: a pose depends on one character.
   * The store keeps them up to date (`edit/follow/leaders.ts`), and the last state of one that is removed. Their time
   * is that of this character's takes. Absent rather than empty.
   */
  readonly leaders?: readonly Character[];
  /** IK settings; absent: `defaultIk`. */
  readonly ik?: IkSetup;
  /** The pose library; absent rather than empty. */
  readonly poses?: readonly NamedPose[];
  /** Selection sets and locked DOFs, saved beside the skeleton; absent rather than empty. */
  readonly sets?: Sets;
  /** Limbs that goals of takes move, saved beside the skeleton; absent rather than empty. */
  readonly limbs?: Limbs;
  /** The files it was read from. */
  readonly sources: readonly SourceFile[];
  /** Files of it that had errors: read later, they are its own. Absent rather than empty. */
  readonly unread?: readonly SourceFile[];
  /** Identities of the parts (`part.ts`). Commands leave these alone; the store keeps them in step with the parts. */
  readonly parts?: PartMarks;
}

/**
 * A take of another character retargeted to this one, live.
 *
 * The data needed from the source is shared here, so that a pose depends on one character only. The store keeps it up
 * to date (`edit/drivers.ts`) when the source changes. If the source is removed, its last state is kept.
 */
export interface Driver {
  /** Id of the source character. */
  readonly sourceId: string;
  readonly source: DriverSource;
  /** In the order of this character's joints, each at most once. */
  readonly pairs: readonly JointPair[];
  readonly options: RetargetOptions;
}

/** The data that retargeting needs of the source character. */
export interface DriverSource {
  readonly name: string;
  readonly skeleton: Skeleton;
  readonly take: Take;
  readonly limbs?: Limbs;
  readonly pose: readonly number[];
  readonly clampsToLimits: boolean;
  readonly timeOffsetSeconds: number;
  readonly space?: Space;
  /** Of a source whose take follows other characters, with these; else absent. */
  readonly placements?: Character['placements'];
  readonly leaders?: Character['leaders'];
}

/** Values set by hand over the take at one time and not keyed; discarded when the time changes. */
export interface Unkeyed {
  readonly timeSeconds: number;
  /** Indices of DOFs (see `dofs.ts`), ascending. */
  readonly dofs: readonly number[];
  /** One per entry of `dofs`. The pose does not contain them, so discarding them leaves no trace. */
  readonly values: readonly number[];
}

/** Where one instance of a character is in the scene: scaled, then rotated, then moved. The scene is in metres, y up. */
export interface Placement {
  readonly position: Vec3;
  /** Radians about x, then y, then z. */
  readonly turn: Vec3;
  readonly scale: number;
}

/** Kept with its content: a file opened later may be the one it needs. */
export interface UnusedFile {
  readonly file: ParsedFile;
  readonly why: string;
  /** The file with errors that it depends on; absent if it belongs to none that was given. */
  readonly waitsFor?: SourceFile;
}

/** The document of a page that has opened nothing. */
export const EMPTY_DOCUMENT: Document = {
  characters: [],
  unused: [],
  isOpeningSample: false,
  charactersMade: 0,
};
/** The placement of a new character: at the scene's origin, neither turned nor scaled. */
export const DEFAULT_PLACEMENT: Placement = { position: [0, 0, 0], turn: [0, 0, 0], scale: 1 };

/** The skin that is drawn; undefined if the character has none. */
export function shownSkin(character: Character): Skin | undefined {
  return character.skins[character.shownSkin];
}

/** The take that plays; undefined with `shownTake` -1, so without takes. */
export function shownTake(character: Character): Take | undefined {
  return character.takes[character.shownTake];
}

/** Whether a take moves it, its own or a retargeted one: else its file pose is shown at any time. */
export function isMoved(character: Character): boolean {
  return character.driver !== undefined || shownTake(character) !== undefined;
}

/** Whether a character is a BVH capture as it is, so that its file holds all of it. */
export function isBvh({ skeleton }: Pick<Character, 'skeleton'>): boolean {
  return isOfJoints({ skeleton }, 'bvh');
}

/** Whether all of a character's joints are of types that one format has: its file holds all of them. */
export function isOfJoints({ skeleton }: Pick<Character, 'skeleton'>, format: JointType['format']): boolean {
  return skeleton?.joints.every(({ motion }) => jointTypeOf(motion).format === format) ?? false;
}

/** Number of characters above which they are found by a map: searching the list for each takes time by the square. */
const FEW = 32;
const byId = perObject((characters: readonly Character[]) => new Map(characters.map((c) => [c.id, c])));

/** The character with this id; undefined if the document has none, or `id` is undefined. */
export function findCharacter({ characters }: Document, id: string | undefined): Character | undefined {
  if (id === undefined) return undefined;
  return characters.length > FEW ? byId(characters).get(id) : characters.find((c) => c.id === id);
}

/** The visible characters that play something, or all that play if none is visible: their time is the transport's. */
export function playingCharacters(document: Document): readonly Character[] {
  const playing = document.characters.filter((c) => c.driver ?? shownTake(c));
  const seen = playing.filter((c) => !c.isHidden);
  return seen.length ? seen : playing;
}

/** Transport time in seconds at which the character's take starts; without a take, where its own second 0 falls. */
export function startSeconds(character: Character): number {
  const source = character.driver?.source;
  const take = source?.take ?? shownTake(character);
  return (take?.range[0] ?? 0) - character.timeOffsetSeconds - (source?.timeOffsetSeconds ?? 0) + 0;
}

/** Transport range in seconds that covers all playing takes; undefined without takes. */
export function rangeOfTakes(document: Document): readonly [number, number] | undefined {
  let start = Number.POSITIVE_INFINITY;
  let end = Number.NEGATIVE_INFINITY;
  for (const character of playingCharacters(document)) {
    const source = character.driver?.source;
    const take = source?.take ?? shownTake(character);
    if (!take) continue;
    const offset = character.timeOffsetSeconds + (source?.timeOffsetSeconds ?? 0);
    start = Math.min(start, take.range[0] - offset);
    end = Math.max(end, take.range[1] - offset);
  }
  return start <= end ? [start, end] : undefined;
}
