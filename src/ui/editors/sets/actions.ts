/** Actions of selection sets and locked DOFs. Edits are loaded on first use. */
import { lockedDofs } from '../../../model/sets.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { needs, needsJoint } from '../../state/actions/needs.ts';
import { selectedJoints, selectedJointsText } from '../../state/joints/selected-joint.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import { dofsOfJoints } from '../posing/pose-edits.ts';
import { isSetSelected, selectByScript, selectSet } from './select-set.ts';

const edits = () => import('./edits.ts');
const setsOf = (wb: Uses<'store'>) => currentCharacter(wb)?.sets?.sets ?? [];
const needsSets = needs('The character has no selection sets.', (wb: Uses<'store'>) => setsOf(wb).length > 0);

function dofsOfSelected(wb: Uses<'store'>): readonly number[] {
  const selected = selectedJoints(wb);
  return selected ? dofsOfJoints(selected.character, selected.joints) : [];
}

/** Whether the DOFs of the selected joints are locked. */
function areLocked(wb: Uses<'store'>): boolean | 'mixed' {
  const selected = selectedJoints(wb);
  const locks = selected ? lockedDofs(selected.character) : new Set();
  const dofs = dofsOfSelected(wb);
  const count = dofs.filter((dof) => locks.has(dof)).length;
  return count === 0 ? false : count === dofs.length || 'mixed';
}

const NUMBERS = [1, 2, 3, 4, 5, 6, 7, 8, 9] as const;

export const SET_ACTIONS: readonly Action[] = [
  {
    id: 'sets.new',
    name: 'New set of selected joints',
    label: (wb) => `New set of ${selectedJointsText(wb)}`,
    also: 'quick select',
    group: 'Select',
    menu: 'Edit/Select',
    section: 2,
    shortcuts: ['Alt+Shift+0'],
    refuses: needsJoint,
    run: async (wb) => (await edits()).newSet(wb),
  },
  {
    id: 'sets.select',
    label: 'Select next set',
    also: 'quick select',
    unchanged: 'That set is already selected.',
    group: 'Select',
    menu: 'Edit/Select',
    section: 2,
    refuses: needsSets,
    run: selectByScript,
  },
  ...NUMBERS.map((number): Action => {
    const at = number - 1;
    return {
      id: `sets.select${number}`,
      name: `Select set ${number}`,
      label: (wb) => `Select ${setsOf(wb)[at]?.name ?? `set ${number}`}`,
      group: 'Select',
      shortcuts: [`Alt+Shift+${number}`],
      unchanged: 'That set is already selected.',
      refuses: needs(`The character has no set ${number}.`, (wb) => (setsOf(wb)[at]?.joints.length ?? 0) > 0),
      checked: (wb) => {
        const character = currentCharacter(wb);
        return character !== undefined && isSetSelected(wb, character, at);
      },
      radio: true,
      run(wb) {
        const character = currentCharacter(wb);
        if (character) selectSet(wb, character, at);
      },
    };
  }),
  {
    id: 'dofs.lock',
    name: 'Lock DOFs of selected joints',
    label: (wb) => `Lock DOFs of ${selectedJointsText(wb)}`,
    detail: 'Posing and keying leave them alone',
    also: 'unlock channel',
    group: 'Pose',
    menu: 'Edit/Pose',
    section: 4,
    shortcuts: ['Alt+Y'],
    refuses: needs(
      (wb: Uses<'store'>) => needsJoint(wb) ?? 'The selected joints have no DOFs.',
      (wb: Uses<'store'>) => dofsOfSelected(wb).length > 0,
    ),
    checked: areLocked,
    async run(wb) {
      const { toggleLocked } = await edits();
      const selected = selectedJoints(wb);
      if (selected) toggleLocked(wb, selected.character, dofsOfSelected(wb));
    },
  },
];
