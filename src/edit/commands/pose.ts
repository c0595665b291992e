/** Posing by hand: DOFs, root translation and morph weights are all DOFs of the character's one list. */
import { isDriven } from '../../evaluate/pose.ts';
import type { Character, Document } from '../../model/document.ts';
import { type CharacterDof, characterDofs, filePose, restPose } from '../../model/dofs.ts';
import { finiteNumber, listOf, oneOf } from '../arguments.ts';
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
      listOf(dofs, '"dofs"');
      for (const { index, value } of dofs) {
        const dof = all[index];
        if (!dof) throw new CommandError(`${character.name} has ${all.length} DOFs; there is no number ${index}.`);
        finiteNumber(value, `The value of DOF ${index}`);
        values.set(index, character.clampsToLimits ? clamp(dof, value) : value);
      }
      return pose(character, values, finiteNumber(timeSeconds, '"timeSeconds"'));
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
      const make = oneOf(to, ['file', 'zero'], '"to"') === 'file' ? filePose : restPose;
      const values = new Map(make(character.skeleton, character.morphs.length).entries());
      return pose(character, values, finiteNumber(timeSeconds, '"timeSeconds"'));
    }),
};

export const setClamping: Command<{ readonly characterId: string; readonly clamps: boolean }> = {
  id: 'pose.setClamping',
  label: (_document, { clamps }) => (clamps ? 'Hold limits' : 'Ignore limits'),
  run: (document, { characterId, clamps }) =>
    changeCharacter(document, characterId, (c) =>
      c.clampsToLimits === oneOf(clamps, [true, false], '"clamps"') ? c : { ...c, clampsToLimits: clamps },
    ),
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

/** What channels drive is changed for this moment only, beside the pose; the rest is the pose. */
function pose(character: Character, values: ReadonlyMap<number, number>, timeSeconds: number): Character {
  const { unkeyed } = character;
  const byHand = new Map<number, number>();
  if (unkeyed?.timeSeconds === timeSeconds) {
    for (const [i, dof] of unkeyed.dofs.entries()) byHand.set(dof, unkeyed.values[i]);
  }
  let changed = false;
  const posed = [...character.pose];
  for (const [dof, value] of values) {
    if (isDriven(character, dof)) {
      changed ||= byHand.get(dof) !== value;
      byHand.set(dof, value);
    } else {
      changed ||= posed[dof] !== value;
      posed[dof] = value;
    }
  }
  if (!changed) return character;
  const next = { ...withoutUnkeyed(character), pose: posed };
  if (byHand.size === 0) return next;
  const dofs = [...byHand.keys()].sort((a, b) => a - b);
  return { ...next, unkeyed: { timeSeconds, dofs, values: dofs.map((dof) => byHand.get(dof) ?? 0) } };
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
