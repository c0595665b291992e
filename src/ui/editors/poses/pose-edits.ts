/** Edits of whole poses, for menus, keys and the library. Loaded on first use. */
import {
  type ApplyPose,
  applyPose,
  keepPose,
  mirrorPose,
  pastePose,
  removePoses,
  renamePose,
} from '../../../edit/commands/poses.ts';
import { poseByNames, takePose } from '../../../edit/pose/by-names.ts';
import { dofCountOf, poseAt } from '../../../evaluate/pose.ts';
import { plural } from '../../kit/number-text.ts';
import { currentCharacter } from '../../state/action.ts';
import { addKeyed } from '../../state/add-keys.ts';
import { attempt } from '../../state/attempt.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import { selectedJointOf } from '../../state/selected-joint.ts';
import type { Uses } from '../../state/workbench.ts';
import { autoKey } from '../posing/pose-edits.ts';

/** Copies the current pose. */
export function copyPose(wb: Uses<'store' | 'transport' | 'posing' | 'messages'>): void {
  const character = currentCharacter(wb);
  if (!character) return;
  const values = new Float64Array(dofCountOf(character));
  poseAt(character, wb.transport.get().timeSeconds, values);
  const pose = poseByNames(character, { name: character.name, values: Array.from(values) });
  wb.posing.copied.set({ pose, from: character.name });
  wb.messages.note(`Copied the pose of ${character.name}.`);
}

/** Reports what did not match. */
export function pasteCopied(wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>): void {
  const character = currentCharacter(wb);
  const copied = wb.posing.copied.get();
  if (!character || !copied) return;
  attempt(wb.messages, () => {
    addKeyed(wb, pastePose, { characterId: character.id, pose: copied.pose, ...moment(wb) });
    const { missing, found } = takePose(character, copied.pose);
    if (missing.length === 0) return;
    const joints = plural(found, 'joint');
    wb.messages.note(`Pasted ${joints}; ${character.name} has no ${someNames(missing)}, which was skipped.`, 'warning');
  });
}

/** @param branch the selected joint and its descendants only */
export function mirror(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  way: 'swap' | 'toOther',
  branch: boolean,
): void {
  const character = currentCharacter(wb);
  if (!character) return;
  const joint = branch ? selectedJointOf(wb, character.id) : undefined;
  attempt(wb.messages, () => addKeyed(wb, mirrorPose, { characterId: character.id, joint, way, ...moment(wb) }));
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

export function removePose(wb: Uses<'store' | 'messages'>, characterId: string, pose: number): void {
  attempt(wb.messages, () => wb.store.apply(removePoses, { characterId, poses: [pose] }));
}

export function take(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  change: Omit<ApplyPose, 'timeSeconds' | 'key'>,
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
