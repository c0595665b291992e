/** Selection sets and locked DOFs of a character. They are saved in its `.sets.json`, beside the skeleton. */
import type { Character, Document } from '../../../model/document.ts';
import { isWithoutSets, type JointSet, type LockedDofs, lockedDofs, NO_SETS, type Sets } from '../../../model/sets.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { indexIn } from '../../arguments.ts';
import { changeCharacter, requireCharacter } from '../../characters.ts';
import { command } from '../../command.ts';
import { CommandError } from '../../command-error.ts';
import { cutName } from '../../cut-name.ts';
import { sameValue } from '../../delta.ts';
import { boolean, filledText, index, optional, text } from '../../schema/shape.ts';
import { CHARACTER, indices } from '../../schema/shared-shapes.ts';
import { characterIn, dofsIn } from '../../step-names.ts';

/** Adds a selection set at the end of the list. */
export const addSet = command({
  id: 'sets.add',
  args: {
    ...CHARACTER,
    name: filledText,
    /** A colour of CSS, such as `#4a90e2`. */
    color: optional(text),
    /** Indices, at least one. */
    joints: indices,
  },
  label: (_document, { name }) => `Add set ${cutName(name)}`,
  run: (document, { characterId, name, color, joints }) =>
    change(document, characterId, (sets, skeleton) => {
      const set = { name, ...(color !== undefined && { color }), joints: jointsIn(skeleton, joints) };
      return { ...sets, sets: [...sets.sets, set] };
    }),
});

/** Changes a selection set: its name, colour or joints. */
export const changeSet = command({
  id: 'sets.change',
  args: {
    ...CHARACTER,
    /** Index in the list. */
    set: index,
    /** Omitted ones are not changed. */
    name: optional(filledText),
    /** A colour of CSS; empty: none of its own. */
    color: optional(text),
    joints: optional(indices),
  },
  label: (document, { characterId, set, name }) =>
    name === undefined ? `Change ${setIn(document, characterId, set)}` : `Rename ${setIn(document, characterId, set)}`,
  run: (document, { characterId, set: at, name, color, joints }) =>
    change(document, characterId, (sets, skeleton) => {
      const { color: before, ...rest } = sets.sets[indexIn(at, 0, sets.sets.length, 'set')];
      const next = color ?? before;
      const set: JointSet = {
        ...rest,
        ...(name !== undefined && { name }),
        ...(next && { color: next }),
        ...(joints && { joints: jointsIn(skeleton, joints) }),
      };
      return { ...sets, sets: sets.sets.with(at, set) };
    }),
});

/** Removes a selection set; its joints stay. */
export const removeSet = command({
  id: 'sets.remove',
  args: {
    ...CHARACTER,
    /** Index in the list. */
    set: index,
  },
  label: (document, { characterId, set }) => `Remove ${setIn(document, characterId, set)}`,
  run: (document, { characterId, set }) =>
    change(document, characterId, (sets) => ({
      ...sets,
      sets: sets.sets.toSpliced(indexIn(set, 0, sets.sets.length, 'set'), 1),
    })),
});

/** Locks DOFs, so that posing by hand and keying leave them alone, or unlocks them. Playback moves locked ones, too. */
export const setLocked = command({
  id: 'dofs.setLocked',
  args: {
    ...CHARACTER,
    /** Indices; of joints, not of morphs. */
    dofs: indices,
    locked: boolean,
  },
  label: (document, { characterId, dofs, locked }) =>
    `${locked ? 'Lock' : 'Unlock'} ${dofsIn(requireCharacter(document, characterId), dofs)}`,
  run: (document, { characterId, dofs, locked }) =>
    change(document, characterId, (sets, skeleton, character) => {
      const all = characterDofs(skeleton, character.morphs);
      for (const dof of dofs) {
        const { joint, name } = all[indexIn(dof, 0, all.length, 'DOF')];
        if (joint < 0) throw new CommandError(`${name} is a morph; only DOFs of joints can be locked.`);
      }
      const now = new Set(lockedDofs(character));
      for (const dof of dofs) {
        if (locked) now.add(dof);
        else now.delete(dof);
      }
      const names = (joint: number) => all.flatMap((dof, i) => (dof.joint === joint && now.has(i) ? [dof.name] : []));
      const rows = new Map(sets.locked.map((row) => [row.joint, row]));
      for (const joint of new Set(dofs.map((dof) => all[dof].joint))) {
        rows.set(joint, { ...rows.get(joint), joint, dofs: [...new Set(names(joint))] });
      }
      const isKept = ({ dofs: own, others }: LockedDofs) => own.length > 0 || others !== undefined;
      return { ...sets, locked: [...rows.values()].filter(isKept).sort((a, b) => a.joint - b.joint) };
    }),
});

/** The character with other sets and locks; none rather than empty ones, unless it has a file of them. */
function change(
  document: Document,
  characterId: string,
  make: (sets: Sets, skeleton: Skeleton, character: Character) => Sets,
): Document {
  return changeCharacter(document, characterId, (character) => {
    const { skeleton, sets: before = NO_SETS, ...rest } = character;
    if (!skeleton) throw new CommandError(`${character.name} has no skeleton, so it has no joints for sets and locks.`);
    const sets = make(before, skeleton, character);
    if (sameValue(sets, before)) return character;
    return isWithoutSets(sets) && !character.parts?.sets?.file ? { ...rest, skeleton } : { ...character, sets };
  });
}

/** Ascending, each once. */
function jointsIn({ joints: all }: Skeleton, joints: readonly number[]): readonly number[] {
  if (joints.length === 0) throw new CommandError('A set must have at least one joint.');
  for (const joint of joints) indexIn(joint, 0, all.length, 'joint');
  return [...new Set(joints)].sort((a, b) => a - b);
}

/** `set arms`, `set 3 of wasp` if there is none; for labels. */
function setIn(document: Document, characterId: string, set: number): string {
  const found = requireCharacter(document, characterId).sets?.sets[set];
  return found ? `set ${cutName(found.name)}` : `set ${set} of ${characterIn(document, characterId)}`;
}
