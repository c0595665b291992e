/** Arguments of the rigging commands, and what these share (`commands/rig*.ts`). */
import type { Vec3 } from '../../math/vec3.ts';
import type { Box, Motion } from '../../model/skeleton.ts';

/**
 * What happens to the skin when joints move. `stays` (bind mode): it is rebound, so that every vertex stays in place in
 * the displayed pose. `follows` (pose mode): its bindings are kept, and it moves along.
 */
export const SKIN_MODES = ['stays', 'follows'] as const;
export type SkinMode = (typeof SKIN_MODES)[number];

export interface Rigging {
  readonly characterId: string;
  /** Default `follows`. */
  readonly skin?: SkinMode | undefined;
  /** Transport time of the displayed pose. Default 0. */
  readonly timeSeconds?: number | undefined;
}

export interface OfJoint extends Rigging {
  readonly joint: number;
}

export interface CreateRig {
  /** Of the character; default `character`. */
  readonly name?: string | undefined;
  /** A character without a skeleton; default: a new one. */
  readonly characterId?: string | undefined;
  /** `stays`: its skin is bound to the root in place; `follows`: as its file says. Default `follows`. */
  readonly skin?: SkinMode | undefined;
}

export interface AddJoint extends Rigging {
  readonly parent: number;
  /** May be empty; default: the parent's with the next number, or `joint3` and the like. */
  readonly name?: string | undefined;
  /** In the parent's space; default: continues the parent's bone. */
  readonly offset?: Vec3 | undefined;
}

export interface RenameJoint extends OfJoint {
  /** May be empty. */
  readonly name: string;
}

export interface ReparentJoint extends OfJoint {
  /** The new parent. */
  readonly parent: number;
  /** The child to insert it before; default: as the last. */
  readonly before?: number | undefined;
}

export interface RemoveJoint extends OfJoint {
  readonly children: 'too' | 'stay';
}

export type NamedAxis = 'x' | 'y' | 'z';
export const AXIS_LETTERS: readonly NamedAxis[] = ['x', 'y', 'z'];

export interface MirrorJoint extends OfJoint {
  /** The axis of the root's space that is mirrored. */
  readonly across: NamedAxis;
}

export interface SetOffset extends OfJoint {
  readonly offset: Vec3;
  /** Whether descendants move along, or stay in place in the displayed pose. */
  readonly children: 'follow' | 'stay';
}

export interface SetMotion extends OfJoint {
  readonly motion: Motion;
}

export interface SetBox extends OfJoint {
  readonly box: Box;
}

export interface SetLength extends OfJoint {
  /** Null removes its own bone. */
  readonly length: number | null;
}

export interface SetFilePose extends Rigging {
  /** Default: all joints. */
  readonly joint?: number | undefined;
  readonly from: 'shown' | 'rest';
}
