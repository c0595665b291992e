/**
 * A DOF that is set by its slider or its number while pins hold: it is where it is set, and the others make room for it
 * as in a drag, near the pose in which the change began. What can't hold slips, and holds again where it can.
 */
import { handStiffness, IS_THERE } from '../../../evaluate/ik/drag/hand-problem.ts';
import { ikProblem } from '../../../evaluate/ik/problem.ts';
import { ikOf, ikPinsOf, type PinTarget } from '../../../evaluate/ik/set-up.ts';
import { solve } from '../../../evaluate/ik/solve.ts';
import type { IkProblem } from '../../../evaluate/ik/state.ts';
import { compileSkeleton } from '../../../evaluate/kinematics.ts';
import { isDriven } from '../../../evaluate/pose.ts';
import { coupleOf } from '../../../model/couples.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import { jointDofCount, rootDofCount } from '../../../model/dofs.ts';
import type { Skeleton } from '../../../model/skeleton.ts';
import type { BesideDof, DofValue } from '../../state/posing.ts';
import { standStill } from '../../state/stand-still.ts';
import type { Uses } from '../../state/workbench.ts';
import { autoKey } from '../posing/pose-edits.ts';

/** Undefined where no pin holds anything beside that DOF. */
export function besidePins(
  wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'posing' | 'settings'>,
  characterId: string,
  dof: number,
): BesideDof | undefined {
  const character = findCharacter(wb.store.document, characterId);
  if (!character?.skeleton || ikOf(character).pins.length === 0) return undefined;
  const count = rootDofCount(character.skeleton) + jointDofCount(character.skeleton);
  if (dof >= count) return undefined;
  // The others move too, which what plays would take back with the next frame.
  let plays = autoKey(wb) !== undefined;
  for (let d = 0; d < count && !plays; d++) plays = isDriven(character, d);
  if (plays) standStill(wb);
  const facts = wb.viewport.character(characterId);
  if (!facts) return undefined;
  const held = wb.posing.ik.targets.targetsOf(characterId, ikOf(character), facts.dofs, facts.worlds);
  return new PinsBeside(wb, character, character.skeleton, dof, facts.dofs.slice(0, count), held);
}

class PinsBeside implements BesideDof {
  private readonly dofs: Float64Array;
  private readonly stiffness: Float64Array;
  private problem: IkProblem | undefined;

  constructor(
    private readonly wb: Uses<'viewport' | 'posing'>,
    private readonly character: Character,
    private readonly skeleton: Skeleton,
    private readonly dof: number,
    private readonly home: Float64Array,
    private readonly held: ReadonlyMap<number, PinTarget>,
  ) {
    this.dofs = home.slice();
    const { firstDof } = compileSkeleton(skeleton);
    // The root translation, before the first joint's own, is the root's.
    const joint = firstDof.findLastIndex((first) => first <= dof);
    this.stiffness = handStiffness(character, skeleton, Math.max(0, joint));
    this.stiffness[dof] = Infinity;
  }

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
    const changed: DofValue[] = [{ index: dof, value }];
    for (let index = 0; index < dofs.length; index++) {
      if (index === dof || dofs[index] === home[index] || coupleOf(skeleton, index)) continue;
      changed.push({ index, value: dofs[index] });
    }
    return changed;
  }

  shown(): void {
    const { wb, character, problem } = this;
    const facts = wb.viewport.character(character.id);
    if (!facts || !problem) return;
    const { binding, bindingCount } = problem.result;
    wb.posing.ik.targets.leave(character.id, ikOf(character), facts.dofs, this.held, {
      binding: Array.from(binding.subarray(0, bindingCount)),
      holders: [],
      locks: [],
      canMove: true,
      rootStays: !ikOf(character).rootIsFree,
    });
  }
}
