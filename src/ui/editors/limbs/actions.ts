/** Actions of limbs, on those of the selected joints. Edits are loaded on first use. */
import { shownTake } from '../../../model/document.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { needs, needsJoint } from '../../state/actions/needs.ts';
import { selectedJointsText } from '../../state/joints/selected-joint.ts';
import { onDemand } from '../../state/on-demand.ts';
import type { Action, Uses, Workbench } from '../../state/workbench.ts';
import { selectedLimbs } from './selected-limbs.ts';

const MENU = 'Edit/Limbs';

async function edit(wb: Workbench, run: (edits: typeof import('./edits.ts')) => void): Promise<void> {
  const edits = await onDemand(wb.messages, 'Limbs', () => import('./edits.ts'));
  if (edits) run(edits);
}

const needsLimb = needs(
  (wb: Uses<'store'>) => needsJoint(wb) ?? 'The selected joint belongs to no limb. Make one first.',
  (wb: Uses<'store'>) => selectedLimbs(wb) !== undefined,
);

export const LIMB_ACTIONS: readonly Action[] = [
  {
    id: 'limb.make',
    name: 'Make limb',
    label: (wb) => `Make limb of ${selectedJointsText(wb)}`,
    detail: 'The selected joints, or the last of three, and the same on the other side',
    also: 'rig ik foot hand',
    group: 'Pose',
    menu: MENU,
    section: 1,
    refuses: needsJoint,
    run: (wb) => edit(wb, (edits) => edits.make(wb)),
  },
  {
    id: 'limb.switch',
    label: 'Switch limb between FK and IK',
    also: 'plant hold foot',
    group: 'Pose',
    menu: MENU,
    section: 1,
    refuses: needsLimb,
    run: (wb) => edit(wb, (edits) => edits.switchLimbs(wb)),
  },
  {
    id: 'limb.key',
    label: 'Key goal of limb',
    group: 'Pose',
    menu: MENU,
    section: 1,
    unchanged: 'The goal is already keyed here.',
    refuses: needsLimb,
    run: (wb) => edit(wb, (edits) => edits.keyGoals(wb)),
  },
  {
    id: 'limb.remove',
    label: 'Remove limb',
    group: 'Pose',
    menu: MENU,
    section: 1,
    refuses: needsLimb,
    run: (wb) => edit(wb, (edits) => edits.remove(wb)),
  },
  {
    id: 'limb.flatten',
    label: 'Flatten limbs',
    also: 'bake',
    group: 'Pose',
    menu: MENU,
    section: 1,
    refuses: needs('The take has no goals of limbs.', (wb: Uses<'store'>) => {
      const character = currentCharacter(wb);
      return character !== undefined && shownTake(character)?.goals !== undefined;
    }),
    run: (wb) => edit(wb, (edits) => edits.flatten(wb)),
  },
];
