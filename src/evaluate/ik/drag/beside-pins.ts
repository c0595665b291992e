import type { Character } from '../../../model/document.ts';
import type { DofValue } from '../../../model/dofs.ts';
import type { Skeleton } from '../../../model/skeleton.ts';
import { compileSkeleton } from '../../kinematics.ts';
import { ikProblem } from '../problem.ts';
import { ikOf, ikPinsOf, type PinTarget } from '../set-up.ts';
import { solve } from '../solve.ts';
import type { IkProblem } from '../state.ts';
import { changedValues } from './changed-values.ts';
import { handStiffness, IS_THERE } from './hand-problem.ts';
import type { Hindrance } from './hindrance.ts';

/**
 * A DOF that is set by its slider or its number while pins hold: it is where it is set, and the others make room for it
 * as in a drag, near the pose in which the change began. What can't hold slips, and holds again where it can.
 */
export class BesidePins {
  private readonly home: Float64Array;
  private readonly dofs: Float64Array;
  private readonly stiffness: Float64Array;
  private problem: IkProblem | undefined;

  /**
   * @param dof into the character's; of a joint or the root
   * @param shown the character's DOFs where the change begins; copied
   * @param held where its pins hold, by id
   */
  constructor(
    private readonly character: Character,
    private readonly skeleton: Skeleton,
    private readonly dof: number,
    shown: Float64Array,
    private readonly held: ReadonlyMap<number, PinTarget>,
  ) {
    const { firstDof, jointCount } = compileSkeleton(skeleton);
    this.home = shown.slice(0, firstDof[jointCount]);
    this.dofs = this.home.slice();
    // The root translation, before the first joint's own, is the root's.
    const joint = firstDof.findLastIndex((first) => first <= dof);
    this.stiffness = handStiffness(character, skeleton, Math.max(0, joint));
    this.stiffness[dof] = Infinity;
  }

  /** The DOF at a value, and those that make room for it. */
  at(value: number): readonly DofValue[] {
    const { character, skeleton, dof, dofs, home } = this;
    dofs[dof] = home[dof] = value;
    const fromHome = home.slice();
    // Anew for each value: what slides or scales by hand makes bones longer, and pins reach further.
    const problem = ikProblem(skeleton, ikPinsOf(ikOf(character), this.held), dofs, {
      clamps: character.clampsToLimits,
      stiffness: this.stiffness,
    });
    this.problem = problem;
    // From the beginning, so that a slider which comes back finds the pose as it was. Only where that doesn't get there,
    // on from where it has come to.
    const worst = (from: Float64Array) => Math.max(...solve(problem, from, 'drag').residuals);
    const gap = worst(fromHome);
    if (gap <= IS_THERE * problem.reach || gap <= worst(dofs)) dofs.set(fromHome);
    return [{ index: dof, value }, ...changedValues(skeleton, home, dofs).filter(({ index }) => index !== dof)];
  }

  /** What keeps pins from holding at the last value; undefined before the first. */
  get hindrance(): Hindrance | undefined {
    if (!this.problem) return undefined;
    const { binding, bindingCount } = this.problem.result;
    return {
      binding: Array.from(binding.subarray(0, bindingCount)),
      holders: [],
      locks: [],
      canMove: true,
      rootStays: !ikOf(this.character).rootIsFree,
    };
  }
}
