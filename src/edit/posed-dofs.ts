/** What hands have changed and no key holds yet: what K keys. */
import { channelOf } from '../evaluate/pose.ts';
import type { Character } from '../model/document.ts';
import { characterDofs } from '../model/dofs.ts';
import { unkeyedAt } from './unkeyed.ts';

/**
 * DOFs that were set by hand and not keyed, ascending: over keys, those of this moment; where there are no keys, those
 * that are at another value than the character had when it was opened.
 *
 * @param opened the character as it came in; only its skeleton, pose and takes are looked at
 * @param timeSeconds of the transport
 */
export function posedDofs(character: Character, opened: Character | undefined, timeSeconds: number): readonly number[] {
  const posed = [...unkeyedAt(character, timeSeconds).keys()];
  if (opened && opened.skeleton === character.skeleton && opened.morphs === character.morphs) {
    const count = characterDofs(character.skeleton, character.morphs).length;
    for (let dof = 0; dof < count; dof++) {
      const value = steadyValue(character, dof);
      const before = steadyValue(opened, dof);
      if (value !== undefined && before !== undefined && value !== before) posed.push(dof);
    }
  }
  return [...new Set(posed)].sort((a, b) => a - b);
}

/** The value at every time of a DOF that is not animated; undefined of one that is. */
function steadyValue(character: Character, dof: number): number | undefined {
  const channel = channelOf(character, dof);
  if (channel && channel.kind !== 'rest') return undefined;
  return channel?.value ?? character.pose[dof] ?? 0;
}
