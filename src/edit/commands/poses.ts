/**
 * Commands on whole poses: mirror, paste from another time or character, and the pose library. The values are stored
 * like all posing by hand (`pose.ts`): pose, unkeyed or keyed. Linked DOFs are skipped.
 */

import { compileSkeleton } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import type { Character, Document } from '../../model/document.ts';
import type { NamedPose } from '../../model/poses.ts';
import { characterDofs, jointDofCount, rootDofCount } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { indexIn } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { cutName, SHORT_NAME } from '../cut-name.ts';
import { blendPoses } from '../pose/blend.ts';
import { takePose } from '../pose/by-names.ts';
import { addPoses, freePoseName, nextPoseName, withPoses } from '../pose/library.ts';
import { counterpartOf, mirroredPose, partnersPose } from '../pose/mirror.ts';
import { partnersByName } from '../pose/sides.ts';
import { boolean, filledText, index, list, number, oneOf, optional } from '../schema/shape.ts';
import { CHARACTER, indices, key, NOW, poseByNames } from '../schema/shared-shapes.ts';
import { characterIn, jointIn } from '../step-names.ts';
import { setValues, withinLimit } from './pose.ts';

/**
 * Mirrors the displayed pose, or copies that of one side to the other. Refuses `toOther` where the joint is on neither
 * side.
 */
export const mirrorPose = command({
  id: 'poses.mirror',
  args: {
    ...NOW,
    /** Only the hierarchy of this joint; absent: the whole character. */
    joint: optional(index),
    /** `swap`: both sides exchange their poses; `toOther`: the joint's hierarchy is copied to the other side. */
    way: oneOf(['swap', 'toOther']),
    key,
  },
  label(document, { characterId, joint, way }) {
    const skeleton = requireSkeleton(document, characterId);
    if (joint === undefined || !skeleton.joints[joint]) return `Mirror pose of ${characterIn(document, characterId)}`;
    const name = jointIn({ skeleton }, joint);
    return way === 'swap' ? `Mirror pose of ${name}` : `Copy pose of ${name} to the other side`;
  },
  run(document, { characterId, joint, way, timeSeconds, key }) {
    const skeleton = requireSkeleton(document, characterId);
    if (joint !== undefined) indexIn(joint, 0, skeleton.joints.length, 'joint');
    if (way === 'toOther') checkSided(skeleton, joint);
    return setValues(document, characterId, timeSeconds, key, (character) => {
      const shown = shownAt(character, timeSeconds);
      const { dofs, joints } = mirroredPose(skeleton, shown, character.clampsToLimits, {
        ...{ joint, way, up: character.space?.up ?? 'y', stays: true },
      });
      const isWhole = way === 'swap' && (joint === undefined || joint === 0);
      const values = new Map<number, number>();
      const { firstDof } = compileSkeleton(skeleton);
      if (isWhole) for (let d = 0; d < firstDof[0]; d++) values.set(d, dofs[d]);
      for (const j of joints) for (let d = firstDof[j]; d < firstDof[j + 1]; d++) values.set(d, dofs[d]);
      if (isWhole) swapWeights(character, shown, values);
      return settled(character, shown, values, key !== undefined);
    });
  },
});

/** Skips joints, DOFs and morphs that the character lacks; DOFs that the pose does not contain are not changed. */
export const pastePose = command({
  id: 'poses.paste',
  args: {
    ...NOW,
    pose: poseByNames,
    /** On the other side: left and right swapped, joints in the middle mirrored. Default false. */
    flipped: optional(boolean),
    key,
  },
  label: (document, { characterId, flipped }) =>
    `Paste pose${flipped ? ' flipped' : ''} on ${characterIn(document, characterId)}`,
  run: (document, { characterId, pose, flipped, timeSeconds, key }) =>
    setValues(document, characterId, timeSeconds, key, (character) => {
      const { values } = takePose(character, pose);
      if (values.size === 0) throw new CommandError(`${character.name} has none of the joints in the pose.`);
      const shown = shownAt(character, timeSeconds);
      const wanted = flipped ? flippedValues(character, shown, values) : values;
      return settled(character, shown, wanted, key !== undefined);
    }),
});

/** Values of a pose on the other side; those of the whole character with its root in place, as in mirroring. */
function flippedValues(
  character: Character,
  shown: Float64Array,
  values: ReadonlyMap<number, number>,
): ReadonlyMap<number, number> {
  const { skeleton, clampsToLimits, space } = character;
  if (!skeleton) return values;
  const all = characterDofs(skeleton, character.morphs);
  const target = shown.slice();
  for (const [d, value] of values) target[d] = value;
  const sources = [...new Set([...values.keys()].map((d) => all[d].joint))].filter((joint) => joint >= 0);
  const isWhole = sources.length === skeleton.joints.length;
  const { dofs, joints } = isWhole
    ? mirroredPose(skeleton, target, clampsToLimits, { way: 'swap', up: space?.up ?? 'y', stays: true })
    : partnersPose(skeleton, target, clampsToLimits, sources, true);
  const flipped = new Map<number, number>();
  const taken = new Set(joints);
  const root = rootDofCount(skeleton);
  // The root's translation is pasted as it is, and mirrored along with all.
  for (const [d, value] of values) if (d < root) flipped.set(d, isWhole ? dofs[d] : value);
  for (let d = root; d < dofs.length; d++) if (taken.has(all[d].joint)) flipped.set(d, dofs[d]);
  const first = root + jointDofCount(skeleton);
  const others = partnersByName(character.morphs.map(({ name }) => name));
  for (const [d, value] of values) {
    if (d < first) continue;
    const other = others[d - first];
    flipped.set(other >= 0 ? first + other : d, value);
  }
  return flipped;
}

/** Saves the displayed pose to the library, under an unused name. */
export const keepPose = command({
  id: 'poses.keep',
  args: { ...NOW, name: optional(filledText) },
  label: (document, { characterId, name }) =>
    `Save ${cutName(keptName(requireCharacter(document, characterId), name))} to pose library`,
  run: (document, { characterId, name, timeSeconds }) =>
    changeCharacter(document, characterId, (character) => {
      const poses = character.poses ?? [];
      const free = keptName(character, name);
      return withPoses(character, [...poses, { name: free, values: Array.from(shownAt(character, timeSeconds)) }]);
    }),
});

/** The unused name of a pose that is saved. */
function keptName({ poses = [] }: Character, name: string | undefined): string {
  return name === undefined ? nextPoseName(poses) : freePoseName(poses, name.trim());
}

/** Replaces a pose of the library by the displayed pose; it keeps its name. */
export const updatePose = command({
  id: 'poses.update',
  args: { ...NOW, pose: index },
  label: (document, { characterId, pose }) => `Update ${poseIn(document, characterId, pose)} in pose library`,
  run: (document, { characterId, pose, timeSeconds }) =>
    changeCharacter(document, characterId, (character) => {
      const before = requirePose(document, characterId, pose);
      const values = Array.from(shownAt(character, timeSeconds));
      const isSame = values.length === before.values.length && values.every((v, d) => v === before.values[d]);
      if (isSame) return character;
      return withPoses(
        character,
        (character.poses ?? []).map((one, i) => (i === pose ? { ...before, values } : one)),
      );
    }),
});

/** Renames a pose of the library. Refuses a name that another one has. */
export const renamePose = command({
  id: 'poses.rename',
  args: { ...CHARACTER, pose: index, name: filledText },
  label: (document, { characterId, pose, name }) =>
    `Rename ${poseIn(document, characterId, pose, SHORT_NAME)} to ${cutName(name.trim(), SHORT_NAME)}`,
  run: (document, { characterId, pose, name }) =>
    changeCharacter(document, characterId, (character) => {
      const before = requirePose(document, characterId, pose);
      const next = name.trim();
      if (next === before.name) return character;
      const poses = character.poses ?? [];
      if (poses.some((other) => other.name === next)) {
        throw new CommandError(`${character.name} already has a pose "${next}".`);
      }
      return withPoses(
        character,
        poses.map((p, i) => (i === pose ? { ...before, name: next } : p)),
      );
    }),
});

/** Removes poses of the library, by index. */
export const removePoses = command({
  id: 'poses.remove',
  args: { ...CHARACTER, poses: indices },
  label: (document, { characterId, poses }) =>
    poses.length === 1 ? `Remove ${poseIn(document, characterId, poses[0])}` : `Remove ${poses.length} poses`,
  run: (document, { characterId, poses }) =>
    changeCharacter(document, characterId, (character) => {
      const gone = new Set(poses);
      for (const pose of poses) requirePose(document, characterId, pose);
      if (gone.size === 0) return character;
      return withPoses(
        character,
        (character.poses ?? []).filter((_, i) => !gone.has(i)),
      );
    }),
});

/**
 * Applies a pose of the library, or blends the displayed one to it.
 * @throws CommandError if `share` is not from 0 to 1, or an index doesn't exist
 */
export const applyPose = command({
  id: 'poses.apply',
  args: {
    ...NOW,
    pose: index,
    /** 1, all of it, by default; 0 is the displayed pose. */
    share: optional(number),
    /** Only these joints and their descendants; absent: the whole character. */
    joints: optional(indices),
    key,
  },
  label(document, { characterId, pose, share = 1 }) {
    const name = poseIn(document, characterId, pose);
    return share === 1 ? `Apply ${name}` : `Blend to ${name}`;
  },
  run(document, { characterId, pose, share = 1, joints, timeSeconds, key }) {
    const { values: kept } = requirePose(document, characterId, pose);
    if (share < 0 || share > 1) throw new CommandError(`"share" must be from 0 to 1, found ${share}.`);
    const { skeleton } = requireCharacter(document, characterId);
    const count = skeleton?.joints.length ?? 0;
    const meant = joints?.map((joint) => indexIn(joint, 0, count, 'joint'));
    return setValues(document, characterId, timeSeconds, key, (character) => {
      const all = characterDofs(skeleton, character.morphs);
      const target = all.map((dof, d) => kept[d] ?? dof.rest);
      const shown = shownAt(character, timeSeconds);
      const blended = blendPoses(skeleton, shown, target, share);
      const compiled = skeleton && compileSkeleton(skeleton);
      const isMeant = (d: number) => {
        if (!meant || !compiled) return true;
        const { firstDof, subtreeEnd } = compiled;
        return meant.some((joint) => d >= firstDof[joint] && d < firstDof[subtreeEnd[joint]]);
      };
      const values = new Map([...blended.entries()].filter(([d]) => isMeant(d)));
      return settled(character, shown, values, key !== undefined);
    });
  },
});

/** Adds poses from a file to the library; existing ones are not added again. */
export const addToLibrary = command({
  id: 'poses.add',
  args: { ...CHARACTER, poses: list(poseByNames) },
  label: (_document, { poses }) =>
    poses.length === 1 ? `Add pose ${cutName(poses[0].name)}` : `Add ${poses.length} poses`,
  run: (document, { characterId, poses }) => changeCharacter(document, characterId, (c) => addPoses(c, poses)),
});

/** All DOFs of a character as displayed. */
function shownAt(character: Character, timeSeconds: number): Float64Array {
  const shown = new Float64Array(dofCountOf(character));
  poseAt(character, timeSeconds, shown);
  return shown;
}

/**
 * Values ready to be stored in the character: within its limits, without linked DOFs. If nothing is keyed, values that
 * are already displayed are skipped, so that a half-identical pose leaves no unkeyed changes on that half.
 */
function settled(
  character: Character,
  shown: Float64Array,
  values: ReadonlyMap<number, number>,
  isKeyed: boolean,
): ReadonlyMap<number, number> {
  const { skeleton, morphs, clampsToLimits } = character;
  const all = characterDofs(skeleton, morphs);
  const follows = new Set(skeleton && compileSkeleton(skeleton).couples.map(({ dof }) => dof));
  const out = new Map<number, number>();
  for (const [d, value] of values) {
    if (follows.has(d) || !all[d]) continue;
    const next = clampsToLimits ? withinLimit(all[d], value) : value;
    if (isKeyed || next !== shown[d]) out.set(d, next);
  }
  return out;
}

/** Swaps the weights of morphs that are counterparts by name: `smile_L` and `smile_R`. */
function swapWeights({ skeleton, morphs }: Character, shown: Float64Array, values: Map<number, number>): void {
  const first = rootDofCount(skeleton) + jointDofCount(skeleton);
  partnersByName(morphs.map(({ name }) => name)).forEach((other, m) => {
    if (other >= 0) values.set(first + m, shown[first + other]);
  });
}

function checkSided(skeleton: Skeleton, joint: number | undefined): void {
  if (joint === undefined) throw new CommandError('Give the joint whose hierarchy is copied to the other side.');
  const name = skeleton.joints[joint].name || `Joint ${joint}`;
  const other = counterpartOf(skeleton, joint);
  if (other === undefined) throw new CommandError(`${name} has no counterpart on the other side, by name or by shape.`);
  if (other === joint) throw new CommandError(`${name} is in the middle. Choose a joint on one side.`);
}

function requireSkeleton(document: Document, characterId: string): Skeleton {
  const { skeleton, name } = requireCharacter(document, characterId);
  if (!skeleton) throw new CommandError(`${name} has no skeleton.`);
  return skeleton;
}

/** The pose's name, for labels. */
function poseIn(document: Document, characterId: string, pose: number, length?: number): string {
  return cutName(requirePose(document, characterId, pose).name, length);
}

function requirePose(document: Document, characterId: string, pose: number): NamedPose {
  const { poses = [] } = requireCharacter(document, characterId);
  return poses[indexIn(pose, 0, poses.length, 'pose')];
}
