/**
 * `marrow/model`: what files are read as. Plain immutable data: skeletons, skins, takes, and characters made of them.
 */
import type { Character } from '../model/document.ts';
import type { Texture } from '../model/files.ts';
import type { Morph } from '../model/morph.ts';
import { newCharacter } from '../model/new-character.ts';
import { wholeFilePose } from '../model/skeleton/dofs.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Skin } from '../model/skin.ts';
import type { Space } from '../model/space.ts';
import type { Take } from '../model/takes/take.ts';

export type { Vec3 } from '../math/vec3.ts';
export type { Diagnostic, Excerpt, Severity } from '../model/diagnostic.ts';
export { type Character, type Placement, shownSkin, shownTake } from '../model/document.ts';
export type { Capture, Texture } from '../model/files.ts';
export type { Morph, MorphRows } from '../model/morph.ts';
export type { NamedValue, PoseByNames, PosedJoint } from '../model/pose-by-names.ts';
export type { Rig } from '../model/rig.ts';
export { type CharacterDof, characterDofs, restPose } from '../model/skeleton/dofs.ts';
export type {
  Box,
  Couple,
  Dof,
  DofUnit,
  EulerOrder,
  Joint,
  Limit,
  Motion,
  Skeleton,
} from '../model/skeleton/skeleton.ts';
export { type Attachments, type Material, type Skin, type Surface, vertexCount } from '../model/skin.ts';
export type { LengthUnit, Space } from '../model/space.ts';
export type { Marker } from '../model/takes/markers.ts';
export type { JointPair, RetargetOptions } from '../model/takes/retarget.ts';
export type { Interpolation, Samples } from '../model/takes/samples.ts';
export type {
  Channel,
  Extrapolation,
  KeyedChannel,
  Keys,
  RestChannel,
  SampledChannel,
  Take,
  Tangents,
} from '../model/takes/take.ts';
export { TANGENT_KINDS, type TangentKind } from '../model/takes/tangent-kinds.ts';
export { UserError } from '../model/user-error.ts';

/** The parts of a new character; all may be left out. */
export interface CharacterParts {
  readonly name?: string;
  readonly skeleton?: Skeleton;
  /** The first is shown. */
  readonly skins?: readonly Skin[];
  readonly morphs?: readonly Morph[];
  /** The first is shown. Their channels are the DOFs of `characterDofs`, in that order. */
  readonly takes?: readonly Take[];
  /** For the materials of skins, by name. */
  readonly textures?: readonly Texture[];
  /** Default true; files of motion capture have no limits anyway. */
  readonly clampsToLimits?: boolean;
  /** Unit, up axis and ground; absent: metres, y up. `readCharacters` finds them out. */
  readonly space?: Space;
}

/** A character of parts, in its file pose: the input of `poseAt`, `writeGlb` and `takeArrays`. */
export function createCharacter(parts: CharacterParts): Character {
  const { name, skeleton, skins = [], morphs = [], takes = [], textures = [], clampsToLimits = true, space } = parts;
  return {
    ...newCharacter('', name ?? skeleton?.name ?? ''),
    ...(skeleton && { skeleton }),
    skins,
    morphs,
    takes,
    textures,
    shownTake: takes.length > 0 ? 0 : -1,
    pose: wholeFilePose(skeleton, morphs),
    clampsToLimits,
    ...(space && { space }),
  };
}
