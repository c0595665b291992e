/** Edits of whole poses, for menus, keys and the library. Loaded on first use. */

import { documentIn } from '../../../edit/change.ts';
import type { ArgsOf } from '../../../edit/command.ts';
import { CommandError } from '../../../edit/command-error.ts';
import { setDofs } from '../../../edit/commands/pose.ts';
import {
  applyPose,
  keepPose,
  mirrorPose,
  pastePose,
  removePoses,
  renamePose,
  updatePose,
} from '../../../edit/commands/poses.ts';
import { poseByNames, takePose } from '../../../edit/pose/by-names.ts';
import { counterpartOf } from '../../../edit/pose/mirror.ts';
import { jointIn } from '../../../edit/step-names.ts';
import { dofCountOf, poseAt } from '../../../evaluate/pose.ts';
import type { Character } from '../../../model/document.ts';
import { findCharacter } from '../../../model/document.ts';
import type { PoseByNames } from '../../../model/pose-by-names.ts';
import { coupleOf } from '../../../model/skeleton/couples.ts';
import { filePose } from '../../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { addKeyed } from '../../state/add-keys.ts';
import { jointsText, selectedJoints, selectedJointsOf } from '../../state/joints/selected-joint.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Uses } from '../../state/workbench.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { autoKey, dofsOfJoints } from '../posing/pose-edits.ts';
import { outermostJoints } from '../rig/outermost.ts';

/** Copies the current pose. */
export function copyPose(wb: Uses<'store' | 'transport' | 'posing' | 'messages'>): void {
  const character = currentCharacter(wb);
  if (!character) return;
  wb.posing.copied.set({ pose: currentPose(wb, character), from: character.name });
  wb.messages.note(`Copied the pose of ${character.name}.`);
}

/** Copies that of the selected joints only; the root's has the position of the character. */
export function copyJoints(wb: Uses<'store' | 'transport' | 'posing' | 'messages'>): void {
  const selected = selectedJoints(wb);
  if (!selected) return;
  const { character, skeleton, joints } = selected;
  const { root, ...whole } = currentPose(wb, character);
  const pose = {
    ...whole,
    ...(joints.includes(0) && root && { root }),
    // The others without values: names may repeat, and then the place in the list tells the joint.
    joints: whole.joints.map((one, joint) => (joints.includes(joint) ? one : { ...one, dofs: [] })),
    weights: [],
  };
  const from = `${jointsText(skeleton, joints)} of ${character.name}`;
  wb.posing.copied.set({ pose, from: joints.length === 1 ? jointsText(skeleton, joints) : from });
  wb.messages.note(`Copied the pose of ${from}.`);
}

/** Resets the selected joints to the file pose. */
export function resetJoints(wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>): void {
  const selected = selectedJoints(wb);
  if (!selected) return;
  const { character, skeleton, joints } = selected;
  const inFile = filePose(skeleton, 0);
  const own = dofsOfJoints(character, joints).filter((index) => !coupleOf(skeleton, index));
  const dofs = own.map((index) => ({ index, value: inFile[index] ?? 0 }));
  const what = joints.length > 1 ? jointsText(skeleton, joints) : jointIn({ skeleton }, joints[0]);
  const label = `Reset ${what} to file pose`;
  const command = { ...setDofs, label: () => label };
  attempt(wb.messages, () => addKeyed(wb, command, { characterId: character.id, dofs, ...moment(wb) }));
}

function currentPose(wb: Uses<'transport'>, character: Character): PoseByNames {
  const values = new Float64Array(dofCountOf(character));
  poseAt(character, wb.transport.get().timeSeconds, values);
  return poseByNames(character, { name: character.name, values: Array.from(values) });
}

/** Reports what did not match. @param flipped pasted on the other side */
export function pasteCopied(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  flipped?: true,
): void {
  const character = currentCharacter(wb);
  const copied = wb.posing.copied.get();
  if (!character || !copied) return;
  attempt(wb.messages, () => {
    addKeyed(wb, pastePose, { characterId: character.id, pose: copied.pose, flipped, ...moment(wb) });
    const { missing } = takePose(character, copied.pose);
    if (missing.length === 0) return;
    const given = copied.pose.joints.filter(({ dofs }) => dofs.length > 0);
    const joints = plural(given.length - missing.length, 'joint');
    wb.messages.note(`Pasted ${joints}; ${character.name} has no ${someNames(missing)}, which was skipped.`, 'warning');
  });
}

/** @param branch the selected joints and their descendants only */
export function mirror(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  way: 'swap' | 'toOther',
  branch: boolean,
): void {
  const character = currentCharacter(wb);
  if (!character) return;
  const joints = branch ? selectedJointsOf(wb, character.id) : [];
  const { skeleton } = character;
  attempt(wb.messages, () => {
    const args = { characterId: character.id, way, ...moment(wb) };
    if (joints.length < 2 || !skeleton) return addKeyed(wb, mirrorPose, { ...args, joint: joints[0] });
    const apart = apartFrom(skeleton, joints, way);
    const text = jointsText(skeleton, joints);
    const label = way === 'swap' ? `Mirror pose of ${text}` : `Copy pose of ${text} to the other side`;
    const command: typeof mirrorPose = {
      ...mirrorPose,
      label: () => label,
      run: (document, all) => apart.reduce((d, joint) => documentIn(mirrorPose.run(d, { ...all, joint })), document),
    };
    addKeyed(wb, command, args);
  });
}

/**
 * Those of the joints that must be mirrored, so that none is twice: not within the hierarchy of another one, and to
 * swap sides only one of two counterparts.
 */
function apartFrom(skeleton: Skeleton, joints: readonly number[], way: 'swap' | 'toOther'): readonly number[] {
  const outermost = outermostJoints(skeleton, joints);
  const isDouble = (joint: number, i: number) => {
    const other = counterpartOf(skeleton, joint);
    return other !== undefined && other !== joint && outermost.indexOf(other) >= 0 && outermost.indexOf(other) < i;
  };
  if (way === 'toOther' && outermost.some(isDouble))
    throw new CommandError('Both sides are selected. Select the joints of the side to copy.');
  return outermost.filter((joint, i) => !isDouble(joint, i));
}

export function keep(wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>): void {
  const character = currentCharacter(wb);
  if (!character) return;
  const { timeSeconds } = moment(wb);
  attempt(wb.messages, () => wb.store.apply(keepPose, { characterId: character.id, timeSeconds }));
}

export function rename(wb: Uses<'store' | 'messages'>, characterId: string, pose: number, name: string): void {
  attempt(wb.messages, () => wb.store.apply(renamePose, { characterId, pose, name }));
}

/** Replaces a saved pose by the current one. */
export function update(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  characterId: string,
  pose: number,
): void {
  const { timeSeconds } = moment(wb);
  const before = wb.store.document;
  attempt(wb.messages, () => wb.store.apply(updatePose, { characterId, pose, timeSeconds }));
  const name = findCharacter(before, characterId)?.poses?.[pose]?.name;
  if (wb.store.document !== before) wb.messages.note(`Updated ${name ?? 'the pose'} to the current pose.`);
}

export function removePose(wb: Uses<'store' | 'messages'>, characterId: string, pose: number): void {
  attempt(wb.messages, () => wb.store.apply(removePoses, { characterId, poses: [pose] }));
}

export function applyWithKeys(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  change: Omit<ArgsOf<typeof applyPose>, 'timeSeconds' | 'key'>,
): void {
  attempt(wb.messages, () => addKeyed(wb, applyPose, { ...change, ...moment(wb) }));
}

/** Time for edits of poses, and whether to key them. Stops playback. */
export function moment(wb: Uses<'store' | 'transport' | 'timeline' | 'settings'>) {
  pausePlayback(wb);
  return { timeSeconds: wb.transport.get().timeSeconds, key: autoKey(wb) };
}

function someNames(names: readonly string[]): string {
  const [first] = names;
  const quoted = `“${first || 'unnamed joint'}”`;
  return names.length > 1 ? `${quoted} and ${names.length - 1} more` : quoted;
}
