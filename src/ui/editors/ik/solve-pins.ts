/** Solving all pins from anywhere, on request: unlike a drag it may jump, and finds a way round where a drag is stuck. */
import { setDofs } from '../../../edit/commands/pose.ts';
import { HandProblem } from '../../../evaluate/ik/drag/hand-problem.ts';
import { LockTrial } from '../../../evaluate/ik/drag/lock-trial.ts';
import { ikProblem } from '../../../evaluate/ik/problem.ts';
import { ikOf, ikPinsOf, stiffnessOf } from '../../../evaluate/ik/set-up.ts';
import { solve } from '../../../evaluate/ik/solve.ts';
import { coupleOf } from '../../../model/couples.ts';
import type { Character } from '../../../model/document.ts';
import { jointDofCount, rootDofCount } from '../../../model/dofs.ts';
import { jointName } from '../../../model/joint-name.ts';
import { attempt } from '../../state/attempt.ts';
import { standStill } from '../../state/stand-still.ts';
import type { Workbench } from '../../state/workbench.ts';
import { autoKey } from '../posing/pose-edits.ts';
import { gapText } from './gap-text.ts';

/** One undo step; says so where nothing better is found. */
export function solvePins(wb: Workbench, character: Character): void {
  const { id, skeleton } = character;
  const setup = ikOf(character);
  standStill(wb);
  const facts = wb.viewport.character(id);
  if (!skeleton || !facts || setup.pins.length === 0) return;
  const { targets } = wb.posing.ik;
  const held = targets.targetsOf(id, setup, facts.dofs, facts.worlds);
  const dofs = facts.dofs.slice();
  const problem = ikProblem(skeleton, ikPinsOf(setup, held), dofs, {
    clamps: character.clampsToLimits,
    stiffness: stiffnessOf(skeleton, setup),
  });
  const { residuals, binding, bindingCount } = solve(problem, dofs, 'settle');
  const count = Math.min(dofs.length, rootDofCount(skeleton) + jointDofCount(skeleton));
  const changed: { index: number; value: number }[] = [];
  for (let index = 0; index < count; index++) {
    if (dofs[index] !== facts.dofs[index] && !coupleOf(skeleton, index)) changed.push({ index, value: dofs[index] });
  }
  const bound = Array.from(binding.subarray(0, bindingCount));
  const worst = residuals.indexOf(Math.max(...residuals));
  const missed = residuals[worst] > 1e-3 * problem.reach;
  // Those that keep the pin from its place, in the pose that was found.
  const locks = missed
    ? new LockTrial(new HandProblem(character, skeleton, dofs, held, { pin: setup.pins[worst].id })).inTheWay()
    : [];
  const hindrance = { binding: bound, holders: [], locks, canMove: true, rootStays: !setup.rootIsFree };
  const { timeSeconds } = wb.transport.get();
  if (changed.length) {
    const command = { ...setDofs, label: () => `Re-solve pins of ${character.name}` };
    attempt(wb.messages, () => {
      wb.store.apply(command, { characterId: id, dofs: changed, timeSeconds, key: autoKey(wb) });
      const after = wb.viewport.character(id);
      if (after) targets.leave(id, setup, after.dofs, held, hindrance);
    });
  }
  if (missed) {
    const { joint } = setup.pins[worst];
    wb.messages.note(
      `${jointName(character.skeleton, joint)} is as close as it can get: ${gapText(character, joint, hindrance)}.`,
    );
  } else if (!changed.length) wb.messages.note('All pins are reached.');
  wb.viewport.requestRender();
}
