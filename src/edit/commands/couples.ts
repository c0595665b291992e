/** Linked DOFs. They belong to the skeleton and are saved in its `.skel`. */

import type { Document } from '../../model/document.ts';
import { couplesOf } from '../../model/skeleton/couples.ts';
import { jointName } from '../../model/skeleton/joint-name.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Couple, Skeleton } from '../../model/skeleton/skeleton.ts';
import { indexIn } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { boundAnew } from '../rig/apply.ts';
import { index, nullable, number, record, text } from '../schema/shape.ts';
import { JOINT } from '../schema/shared-shapes.ts';
import { jointIn } from '../step-names.ts';

/** The DOF that a linked one follows, with gain and offset. */
export interface FollowedDof {
  /** Index; may be the joint itself. */
  readonly joint: number;
  /** The name of one of that joint's DOFs. */
  readonly dof: string;
  /** Per unit of the followed DOF: radians, or length units. */
  readonly gain: number;
  /** In the unit of the linked DOF. */
  readonly offset: number;
}

/** Refuses links that would make a DOF follow itself, directly or indirectly. */
export const setCouple = command({
  id: 'rig.setCouple',
  args: {
    ...JOINT,
    /** The name of one of its DOFs. */
    dof: text,
    /** The DOF to follow, replacing the previous one; null unlinks it, at the value that was last set. */
    follows: nullable(record({ joint: index, dof: text, gain: number, offset: number })),
  },
  label(document, { characterId, joint, dof, follows }) {
    const own = jointIn(requireCharacter(document, characterId), joint);
    return `${follows ? 'Link' : 'Unlink'} ${dof} of ${own}`;
  },
  run(document: Document, args) {
    const { characterId, joint, dof, follows } = args;
    const next = changeCharacter(document, characterId, (character) => {
      const { skeleton } = character;
      if (!skeleton) throw new CommandError(`${character.name} has no skeleton.`);
      const { joints } = skeleton;
      indexIn(joint, 0, joints.length, 'joint');
      const own = requireDof(skeleton, joint, dof);
      const { couples: before = [], ...rest } = joints[joint];
      const others = before.filter((couple) => couple.dof !== own);
      const couple = follows && checkedCouple(skeleton, own, follows);
      const now = before.find((one) => one.dof === own);
      if (couple ? now && sameCouple(now, couple) : !now) return character;
      const order = dofsOf(rest.motion).map(({ name }) => name);
      const couples = (couple ? [...others, couple] : others).sort(
        (a, b) => order.indexOf(a.dof) - order.indexOf(b.dof),
      );
      const changed = couples.length ? { ...rest, couples } : rest;
      const next = { ...skeleton, joints: joints.map((one, j) => (j === joint ? changed : one)) };
      if (couple) refuseCycle(next, joint, own);
      return { ...character, skeleton: next };
    });
    return boundAnew(document, args, next);
  },
});

function checkedCouple(skeleton: Skeleton, dof: string, { joint, dof: followed, gain, offset }: FollowedDof): Couple {
  indexIn(joint, 0, skeleton.joints.length, 'joint');
  return {
    dof,
    joint,
    follows: requireDof(skeleton, joint, followed),
    gain,
    offset,
  };
}

function requireDof(skeleton: Skeleton, joint: number, name: unknown): string {
  const dofs = dofsOf(skeleton.joints[joint].motion);
  const found = dofs.find((dof) => dof.name === name);
  if (found) return found.name;
  const there = dofs.map((dof) => dof.name).join(', ') || 'none';
  throw new CommandError(`${jointName(skeleton, joint)} has no DOF ${String(name)}; it has ${there}.`);
}

/** An existing cycle is no reason to refuse another link. */
function refuseCycle(skeleton: Skeleton, joint: number, dof: string): void {
  const start = { joint, dof };
  let now = start;
  for (let steps = 0; steps <= couplesOf(skeleton).circular.length; steps++) {
    const couple = skeleton.joints[now.joint].couples?.find((one) => one.dof === now.dof);
    if (!couple) return;
    now = { joint: couple.joint, dof: couple.follows };
    if (now.joint === start.joint && now.dof === start.dof) {
      throw new CommandError(`${dof} of ${jointName(skeleton, joint)} would follow itself.`);
    }
  }
}

function sameCouple(a: Couple, b: Couple): boolean {
  return a.joint === b.joint && a.follows === b.follows && a.gain === b.gain && a.offset === b.offset;
}
