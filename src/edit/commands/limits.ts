/**
 * Limits of the joints' DOFs. They belong to the skeleton and are saved in its `.skel`; poses and keys beyond them are
 * kept, and clamped in display.
 */

import type { Document } from '../../model/document.ts';
import { characterDofs, firstDofs } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import { type Limit, UNLIMITED } from '../../model/skeleton/skeleton.ts';
import { indexIn } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { index, number } from '../schema/shape.ts';
import { CHARACTER } from '../schema/shared-shapes.ts';
import { dofIn } from '../step-names.ts';

/** A DOF of a character, as argument of commands. */
export interface OfDof {
  readonly characterId: string;
  /** Index into the character's DOFs (`model/dofs.ts`), of one that takes limits. */
  readonly dof: number;
}

/** `min` and `max` in the DOF's unit: radians or length units. */
export const setLimit = command({
  id: 'skeleton.setLimit',
  args: { ...CHARACTER, dof: index, min: number, max: number },
  label: (document, args) => `Set limits of ${nameOf(document, args)}`,
  run(document, { characterId, dof, min, max }) {
    if (min > max) throw new CommandError(`The lower limit ${min} is above the upper limit ${max}.`);
    return withLimit(document, characterId, dof, { min, max });
  },
});

/** Removes both limits of a DOF: it becomes unlimited. */
export const clearLimit = command({
  id: 'skeleton.clearLimit',
  args: { ...CHARACTER, dof: index },
  label: (document, args) => `Remove limits of ${nameOf(document, args)}`,
  run: (document, { characterId, dof }) => withLimit(document, characterId, dof, UNLIMITED),
});

/** Other joints keep their identity. */
function withLimit(document: Document, characterId: string, dof: number, limit: Limit): Document {
  return changeCharacter(document, characterId, (character) => {
    const { skeleton, morphs } = character;
    const all = characterDofs(skeleton, morphs);
    indexIn(dof, 0, all.length, 'DOF');
    const { joint, takesLimits } = all[dof];
    if (!skeleton || !takesLimits) {
      throw new CommandError(`${dofIn(character, dof)} can’t have limits. Only joint DOFs other than quaternions can.`);
    }
    const { motion, limits } = skeleton.joints[joint];
    const own = dof - firstDofs(skeleton)[joint];
    const before = limits[own] ?? UNLIMITED;
    if (before.min === limit.min && before.max === limit.max) return character;
    const next = dofsOf(motion).map((_, i) => (i === own ? limit : (limits[i] ?? UNLIMITED)));
    const joints = skeleton.joints.map((j, i) => (i === joint ? { ...j, limits: next } : j));
    return { ...character, skeleton: { ...skeleton, joints } };
  });
}

function nameOf(document: Document, { characterId, dof }: OfDof): string {
  return dofIn(requireCharacter(document, characterId), dof);
}
