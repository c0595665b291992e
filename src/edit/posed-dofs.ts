/** Changes made by hand that are not keyed yet; K keys these. */
import { channelOf, isDriven } from '../evaluate/pose.ts';
import { type Character, shownTake } from '../model/document.ts';
import { characterDofs } from '../model/skeleton/dofs.ts';
import { unkeyedAt } from './unkeyed.ts';

/**
 * DOFs that were set by hand and not keyed, ascending: over keys, the unkeyed changes at this time; without keys, those
 * whose values differ from when the character was opened.
 *
 * @param opened the character as it was opened; only its skeleton, pose and takes are used
 * @param timeSeconds of the transport
 */
export function posedDofs(character: Character, opened: Character | undefined, timeSeconds: number): readonly number[] {
  const posed = [...unkeyedAt(character, timeSeconds).keys()];
  if (opened && opened.skeleton === character.skeleton && opened.morphs === character.morphs) {
    const reference = showingSameTake(opened, character);
    const count = characterDofs(character.skeleton, character.morphs).length;
    for (let dof = 0; dof < count; dof++) {
      const value = steadyValue(character, dof);
      const before = steadyValue(reference, dof);
      if (value !== undefined && before !== undefined && value !== before) posed.push(dof);
    }
  }
  return [...new Set(posed)].sort((a, b) => a - b);
}

/** The character as opened, with the take that it shows now, since each has its own rest values. */
function showingSameTake(opened: Character, now: Character): Character {
  const name = shownTake(now)?.name;
  if (name === undefined) return { ...opened, shownTake: -1 };
  const index = opened.takes.findIndex((take) => take.name === name);
  return index < 0 ? opened : { ...opened, shownTake: index };
}

/** The constant value of a DOF that is not animated; undefined for others. */
function steadyValue(character: Character, dof: number): number | undefined {
  const channel = channelOf(character, dof);
  if (channel && isDriven(character, dof)) return undefined;
  return channel?.kind === 'rest' ? channel.value : (character.pose[dof] ?? 0);
}
