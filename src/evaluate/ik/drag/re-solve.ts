import type { Character } from '../../../model/document.ts';
import { lockedDofs } from '../../../model/sets.ts';
import type { DofValue } from '../../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { ikProblem } from '../problem.ts';
import { ikOf, ikPinsOf, type PinTarget, stiffnessOf } from '../set-up.ts';
import { solve } from '../solve.ts';
import { changedValues } from './changed-values.ts';
import { HandProblem } from './hand-problem.ts';
import type { Hindrance } from './hindrance.ts';
import { LockTrial } from './lock-trial.ts';

/** Fraction of the reach from which a gap is reported. */
const MISSED = 1e-3;

/** The result of re-solving a character's pins. */
export interface Resolved {
  readonly changes: readonly DofValue[];
  /** The joint of the pin farthest from its target; undefined if all are reached. */
  readonly missed: number | undefined;
  readonly hindrance: Hindrance;
}

/**
 * Re-solves all pins of a character with restarts: unlike a drag it may jump, and finds a solution where a drag is
 * stuck.
 *
 * @param shown the character's DOFs
 * @param held targets of its pins, by id; at least one
 */
export function resolvePins(
  character: Character,
  skeleton: Skeleton,
  shown: Float64Array,
  held: ReadonlyMap<number, PinTarget>,
): Resolved {
  const setup = ikOf(character);
  const dofs = shown.slice();
  const problem = ikProblem(skeleton, ikPinsOf(setup, held), dofs, {
    clamps: character.clampsToLimits,
    stiffness: stiffnessOf(skeleton, setup, lockedDofs(character)),
  });
  const { residuals, binding, bindingCount } = solve(problem, dofs, 'settle');
  const worst = residuals.indexOf(Math.max(...residuals));
  const { id, joint } = setup.pins[worst];
  const isMissed = residuals[worst] > MISSED * problem.reach;
  // Locks that keep the pin from its target in the solved pose.
  const locks = isMissed ? new LockTrial(new HandProblem(character, skeleton, dofs, held, { pin: id })).inTheWay() : [];
  return {
    changes: changedValues(skeleton, shown, dofs),
    missed: isMissed ? joint : undefined,
    hindrance: {
      binding: Array.from(binding.subarray(0, bindingCount)),
      holders: [],
      locks,
      canMove: true,
      rootStays: !setup.rootIsFree,
    },
  };
}
