/** A character in the pose of the file: all that is written of it but its motion. */
import { compileSkeleton } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { type Character, shownSkin } from '../../model/document.ts';
import type { Skin } from '../../model/skin.ts';
import { type AttachmentSets, attachmentSets } from './attachments.ts';
import { bodyOf } from './body.ts';
import { type JointNodes, jointNodes, NODE_WIDTH, nodeWorlds, nodeWriter } from './joint-nodes.ts';
import { type ExchangeOptions, TOLERANCE_OF_SIZE } from './options.ts';
import { sizeOf } from './size.ts';

/** The parts of a character that are written, apart from its motion. */
export interface FilePose {
  readonly skin: Skin | undefined;
  /** Absent without a skeleton. */
  readonly joints: FileJoints | undefined;
  /** Absent without a skeleton or a skin. */
  readonly sets: AttachmentSets | undefined;
  /** All DOFs in the pose of the nodes. */
  readonly restPose: readonly number[];
  readonly size: number;
  readonly tolerance: number;
}

/** The joints of a character as nodes in the file pose. */
export interface FileJoints {
  readonly skeleton: NonNullable<Character['skeleton']>;
  readonly nodes: JointNodes;
  /** The nodes' numbers in the pose of the file. */
  readonly rest: Float64Array;
  /** World matrices of the nodes in that pose. */
  readonly worlds: Float64Array;
}

/** A character in its file pose, with its skin, or a body of boxes and bones if it has none and options ask for it. */
export function filePoseOf(character: Character, { body, influences, tolerance }: ExchangeOptions): FilePose {
  const { skeleton } = character;
  const { unkeyed: _unkeyed, driver: _driver, ...plain } = character;
  const rest = new Float64Array(dofCountOf(character));
  poseAt({ ...plain, shownTake: -1 }, 0, rest);
  let joints: FileJoints | undefined;
  if (skeleton) {
    const compiled = compileSkeleton(skeleton);
    const nodes = jointNodes(compiled);
    const row = new Float64Array(NODE_WIDTH * nodes.nodes.length);
    nodeWriter(compiled, nodes)(rest, row, 0);
    const worlds = new Float64Array(16 * nodes.nodes.length);
    nodeWorlds(nodes.nodes, row, 0, worlds);
    joints = { skeleton, nodes, rest: row, worlds };
  }
  const own = shownSkin(character);
  const size = sizeOf(character, own, rest);
  const bare = body &&
    joints && { skeleton: joints.skeleton, worlds: joints.worlds, lastOf: joints.nodes.lastOf, size };
  const skin = own ?? (bare ? bodyOf(bare, 'body') : undefined);
  const sets = skin && skeleton && attachmentSets(skin, skeleton.joints.length, skeleton.joints.length, influences);
  return { skin, joints, sets, restPose: [...rest], size, tolerance: tolerance ?? TOLERANCE_OF_SIZE * size };
}
