/** Posing by hand: DOFs, root translation and morph weights are all DOFs of the character's one list. */
import { isDriven } from '../../evaluate/pose.ts';
import type { Character, Document } from '../../model/document.ts';
import { type CharacterDof, characterDofs, filePose, restPose } from '../../model/dofs.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { type Command, CommandError } from '../store.ts';

export interface DofValue {
  /** Into the character's DOFs (`model/dofs.ts`). */
  readonly index: number;
  readonly value: number;
}

export interface SetDofs {
  readonly characterId: string;
  readonly dofs: readonly DofValue[];
  /** The transport's time: what a channel drives is changed for this moment only. */
  readonly timeSeconds: number;
}

/**
 * Sets DOFs, clamped to their limits while the character's switch is on. A DOF that a channel drives becomes
 * *unkeyed*: it shows until time moves.
 */
export const setDofs: Command<SetDofs> = {
  id: 'pose.setDofs',
  label(document, { characterId, dofs }) {
    const character = requireCharacter(document, characterId);
    if (dofs.length !== 1) return 'Set pose';
    return `Set ${dofName(character, dofs[0].index)}`;
  },
  run: (document, { characterId, dofs, timeSeconds }) =>
    changeCharacter(document, characterId, (character) => {
      const all = characterDofs(character.skeleton, character.morphs);
      const values = new Map<number, number>();
      for (const { index, value } of dofs) {
        const dof = all[index];
        if (!dof) throw new CommandError(`${character.name} has ${all.length} DOFs; there is no number ${index}.`);
        if (!Number.isFinite(value)) throw new CommandError(`A DOF needs a finite number; ${value} is none.`);
        values.set(index, character.clampsToLimits ? clamp(dof, value) : value);
      }
      return pose(character, values, timeSeconds);
    }),
};

export interface ResetPose {
  readonly characterId: string;
  /** The pose of the file, or every DOF at rest. */
  readonly to: 'file' | 'zero';
  readonly timeSeconds: number;
}

export const resetPose: Command<ResetPose> = {
  id: 'pose.reset',
  label: (_document, { to }) => (to === 'file' ? 'Reset to file pose' : 'Reset to zero pose'),
  run: (document, { characterId, to, timeSeconds }) =>
    changeCharacter(document, characterId, (character) => {
      const make = to === 'file' ? filePose : restPose;
      return pose(character, new Map(make(character.skeleton, character.morphs.length).entries()), timeSeconds);
    }),
};

export const setClamping: Command<{ readonly characterId: string; readonly clamps: boolean }> = {
  id: 'pose.setClamping',
  label: (_document, { clamps }) => (clamps ? 'Hold limits' : 'Ignore limits'),
  run: (document, { characterId, clamps }) =>
    changeCharacter(document, characterId, (c) => (c.clampsToLimits === clamps ? c : { ...c, clampsToLimits: clamps })),
};

/** The document without what was set by hand at another time than this; the same object where there is nothing. */
export function dropUnkeyed(document: Document, timeSeconds: number): Document {
  const stale = (c: Character) => c.unkeyed !== undefined && c.unkeyed.timeSeconds !== timeSeconds;
  if (!document.characters.some(stale)) return document;
  return { ...document, characters: document.characters.map((c) => (stale(c) ? withoutUnkeyed(c) : c)) };
}

export function withoutUnkeyed(character: Character): Character {
  if (!character.unkeyed) return character;
  const { unkeyed: _gone, ...rest } = character;
  return rest;
}

function pose(character: Character, values: ReadonlyMap<number, number>, timeSeconds: number): Character {
  const before = character.unkeyed?.timeSeconds === timeSeconds ? character.unkeyed.dofs : [];
  const driven = [...values.keys()].filter((index) => isDriven(character, index));
  const unkeyed = [...new Set([...before, ...driven])].sort((a, b) => a - b);
  const changed = character.pose.map((value, index) => values.get(index) ?? value);
  const sameValues = changed.every((value, index) => value === character.pose[index]);
  if (sameValues && unkeyed.length === before.length) return character;
  const next = { ...withoutUnkeyed(character), pose: changed };
  return unkeyed.length ? { ...next, unkeyed: { timeSeconds, dofs: unkeyed } } : next;
}

function clamp({ limit, unit }: CharacterDof, value: number): number {
  // Weights beyond 0 and 1 exaggerate a morph, which is wanted; crossed limits are none.
  if (unit === 'weight' || limit.min > limit.max) return value;
  return Math.min(limit.max, Math.max(limit.min, value));
}

function dofName(character: Character, index: number): string {
  const dof = characterDofs(character.skeleton, character.morphs)[index];
  if (!dof) return `DOF ${index}`;
  if (dof.joint < 0) return `morph ${dof.name}`;
  const joint = character.skeleton?.joints[dof.joint]?.name || `joint ${dof.joint}`;
  return `${dof.name} of ${joint}`;
}
