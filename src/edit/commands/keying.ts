/** Keying poses. */

import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { steppedCharacter } from '../../evaluate/stepped-take.ts';
import { shownTake } from '../../model/document.ts';
import { indexIn } from '../arguments.ts';
import { keyable } from '../channel-edits.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { keyDofs } from '../key-dofs.ts';
import { touchedByActive } from '../layers/layer-values.ts';
import { controlCountOf, goalValueAt, withGoalsPosed } from '../limbs/goal-dofs.ts';
import { openValues } from '../pose/locks.ts';
import { optional } from '../schema/shape.ts';
import { indices, KEY_OPTIONS, NOW } from '../schema/shared-shapes.ts';
import { characterIn, dofsIn } from '../step-names.ts';

/**
 * Keys the pose displayed at that time: the take with unkeyed changes, within limits. Nothing moves at that time. A
 * character without a take gets one, in which DOFs without keys rest at their values. Sampled channels are skipped;
 * refused if there are no others. Locked DOFs are skipped, too.
 */
export const keyPose = command({
  id: 'pose.key',
  args: {
    ...NOW,
    /**
     * Indices into the character's DOFs (`model/dofs.ts`) and curves of goals; default all DOFs. A limb in IK is keyed
     * by its goal.
     */
    dofs: optional(indices),
    ...KEY_OPTIONS,
  },
  label: (document, { characterId, dofs }) =>
    dofs === undefined
      ? `Key pose of ${characterIn(document, characterId)}`
      : `Key ${dofsIn(requireCharacter(document, characterId), dofs)}`,
  run(document, { characterId, dofs, timeSeconds, ...options }) {
    const character = requireCharacter(document, characterId);
    const displayed = options.stepped ? steppedCharacter(character) : character;
    const shown = new Float64Array(dofCountOf(character));
    poseAt(displayed, timeSeconds, shown);
    const values = new Map<number, number>();
    const touched = touchedByActive(character);
    if (dofs === undefined) {
      for (const [dof, value] of shown.entries()) if (touched(dof)) values.set(dof, value);
    } else
      for (const dof of dofs) {
        const index = indexIn(dof, 0, controlCountOf(character), 'DOF');
        values.set(index, index < shown.length ? shown[index] : goalValueAt(displayed, index, timeSeconds));
      }
    const { open, locked } = openValues(character, withGoalsPosed(displayed, values, timeSeconds, true));
    const { character: keyed, keys } = keyDofs(character, open, timeSeconds, options);
    const take = shownTake(keyed);
    if (take) keyable(take, [...open.keys()]);
    const told = locked > 0 && { locked };
    return { document: changeCharacter(document, characterId, () => keyed), keys, ...told };
  },
});
