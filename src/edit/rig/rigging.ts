/** What the commands of rigging are asked, and what they have in common (`commands/rig*.ts`). */
import type { Vec3 } from '../../math/vec3.ts';
import type { Box, Motion } from '../../model/skeleton.ts';

/**
 * What becomes of the skin where joints come to stand elsewhere. `stays` (bind mode): it is bound anew, so that every
 * vertex stays where it is in the pose shown. `follows` (pose mode): its bindings are kept, and it goes along.
 */
export const SKIN_MODES = ['stays', 'follows'] as const;
export type SkinMode = (typeof SKIN_MODES)[number];

export interface Rigging {
  readonly characterId: string;
  /** Absent: `follows`. */
  readonly skin?: SkinMode | undefined;
  /** Of the transport: the pose shown is the one at that time. Absent: 0. */
  readonly timeSeconds?: number | undefined;
}

export interface OfJoint extends Rigging {
  readonly joint: number;
}

export interface CreateRig {
  /** Of the character; absent: `character`. */
  readonly name?: string | undefined;
  /** A character that waits for a skeleton; absent: a new one is made. */
  readonly characterId?: string | undefined;
  /** `stays`: its skin is bound to the root where it stands; `follows`: as its file says. Absent: `follows`. */
  readonly skin?: SkinMode | undefined;
}

export interface AddJoint extends Rigging {
  readonly parent: number;
  /** May be empty; absent: `joint3` and the like, or the parent's with the next number. */
  readonly name?: string | undefined;
  /** In the parent's space; absent: continues the parent's bone. */
  readonly offset?: Vec3 | undefined;
}

export interface RenameJoint extends OfJoint {
  /** May be empty. */
  readonly name: string;
}

export interface ReparentJoint extends OfJoint {
  /** The joint that it hangs on from now on. */
  readonly parent: number;
  /** The child of that joint which it comes to stand before; absent: it is the last. */
  readonly before?: number | undefined;
}

export interface RemoveJoint extends OfJoint {
  readonly children: 'too' | 'stay';
}

export type NamedAxis = 'x' | 'y' | 'z';
export const AXIS_LETTERS: readonly NamedAxis[] = ['x', 'y', 'z'];

export interface MirrorJoint extends OfJoint {
  /** The axis of the root's space across which it is mirrored. */
  readonly across: NamedAxis;
}

export interface SetOffset extends OfJoint {
  readonly offset: Vec3;
  /** Whether the joints below go along, or stay where they are in the pose shown. */
  readonly children: 'follow' | 'stay';
}

export interface SetMotion extends OfJoint {
  readonly motion: Motion;
}

export interface SetBox extends OfJoint {
  readonly box: Box;
}

export interface SetLength extends OfJoint {
  /** Null: it has no bone of its own any more. */
  readonly length: number | null;
}

export interface SetFilePose extends Rigging {
  /** Absent: all joints. */
  readonly joint?: number | undefined;
  readonly from: 'shown' | 'rest';
}
