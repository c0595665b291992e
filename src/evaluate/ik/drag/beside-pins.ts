import type { Character } from '../../../model/document.ts';
import type { Pin } from '../../../model/ik.ts';
import type { DofValue } from '../../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { compileSkeleton } from '../../kinematics.ts';
import { bendsWith, limbOf, union } from '../limb.ts';
import { ikProblem } from '../problem.ts';
import { ikOf, ikPinsOf, type PinTarget } from '../set-up.ts';
import { solve } from '../solve.ts';
import type { IkProblem } from '../state.ts';
import { changedValues } from './changed-values.ts';
import { holding } from './drag-reach.ts';
import { handStiffness, IS_THERE } from './hand-problem.ts';
import type { Hindrance } from './hindrance.ts';

/**
 * Sets DOFs of a joint while pins hold, by slider, number field or gizmo: they take their values, and the others adapt
 * to keep the pins, as in a drag, close to the pose at the start of the change. Pins that can't be kept slip, and hold
 * again as soon as they can.
 */
export class BesidePins {
  private readonly home: Float64Array;
  private readonly dofs: Float64Array;
  private readonly stiffness: Float64Array;
  private readonly character: Character;
  private problem: IkProblem | undefined;

  /**
   * @param changed indices into the character's DOFs, all of one joint or the root
   * @param shown the character's DOFs at the start of the change; copied
   * @param held targets of its pins and of the feet that stand, by id
   * @param standing feet that hold without a pin: then nothing bends but the limbs of what holds
   */
  constructor(
    character: Character,
    private readonly skeleton: Skeleton,
    private readonly changed: readonly number[],
    shown: Float64Array,
    private readonly held: ReadonlyMap<number, PinTarget>,
    standing: readonly Pin[] = [],
  ) {
    this.character = holding(character, standing);
    const { firstDof, jointCount } = compileSkeleton(skeleton);
    this.home = shown.slice(0, firstDof[jointCount]);
    this.dofs = this.home.slice();
    // Root translation comes before the first joint's DOFs and belongs to the root.
    const joint = Math.max(
      0,
      firstDof.findLastIndex((first) => first <= changed[0]),
    );
    this.stiffness = handStiffness(character, skeleton, joint);
    for (const dof of changed) this.stiffness[dof] = Infinity;
    if (standing.length === 0) return;
    // The body goes where its handle is dragged, and nowhere else: its legs bend, and not its back.
    const bends = bendsWith(skeleton, union(ikOf(this.character).pins.map((pin) => limbOf(skeleton, pin.joint))));
    for (let dof = 0; dof < this.stiffness.length; dof++)
      if (dof < firstDof[joint + 1] || !bends(dof)) this.stiffness[dof] = Infinity;
  }

  /** The changed DOFs at their values, with those that adapt to them. */
  at(values: readonly DofValue[]): readonly DofValue[] {
    const { character, skeleton, changed, dofs, home } = this;
    for (const { index, value } of values) dofs[index] = home[index] = value;
    const fromHome = home.slice();
    // Recomputed for each value: sliding or scaling DOFs change the length of bones, and so the reach of pins.
    const problem = ikProblem(skeleton, ikPinsOf(ikOf(character), this.held), dofs, {
      clamps: character.clampsToLimits,
      stiffness: this.stiffness,
    });
    this.problem = problem;
    // From the start, so that moving a slider back restores the pose. Continues from the last pose only if that gets
    // nearer.
    const worst = (from: Float64Array) => Math.max(...solve(problem, from, 'drag').residuals);
    const gap = worst(fromHome);
    if (gap <= IS_THERE * problem.reach || gap <= worst(dofs)) dofs.set(fromHome);
    return [...values, ...changedValues(skeleton, home, dofs).filter(({ index }) => !changed.includes(index))];
  }

  /** Why pins can't hold at the last value; undefined before the first. */
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
