/** Actions of inverse kinematics: pins, joint locks, root motion. Their scripts are loaded on first use. */

import { defaultIk } from '../../../model/ik.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { needs, needsJoint, needsSkeleton } from '../../state/actions/needs.ts';
import { selectedJoint, selectedJoints, selectedJointsText } from '../../state/joints/selected-joint.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import { type ChosenReach, REACH_MEANINGS, REACH_NAMES, reachShown } from './reach-choice.ts';

const MENU = 'Edit/Pins';
const REACH_MENU = 'Edit/Reach of IK';
const edits = () => import('./pin-edits.ts');
const ikOfCurrent = (wb: Uses<'store'>) => {
  const character = currentCharacter(wb);
  return character?.skeleton && (character.ik ?? defaultIk(character.skeleton));
};
const needsPins = needs('The character has no pins.', (wb: Uses<'store'>) => (ikOfCurrent(wb)?.pins.length ?? 0) > 0);
const isEach = (wb: Uses<'store'>, is: (joint: number) => boolean | undefined) =>
  selectedJoints(wb)?.joints.every((joint) => is(joint) ?? false) ?? false;
/** Whether each of the selected joints is. */
const arePinned = (wb: Uses<'store'>) => {
  const ik = ikOfCurrent(wb);
  return isEach(wb, (joint) => ik?.pins.some((pin) => pin.joint === joint));
};
const areLocked = (wb: Uses<'store'>) => {
  const ik = ikOfCurrent(wb);
  return isEach(wb, (joint) => ik?.stiff.some((one) => one.joint === joint && one.stiffness === undefined));
};

/** @param what its name in the menu if that tells more */
function reachAction(reach: ChosenReach, id: string, what?: (wb: Uses<'store'>) => string): Action {
  return {
    id,
    name: `IK reach: ${REACH_NAMES[reach].toLowerCase()}`,
    label: what ?? REACH_NAMES[reach],
    detail: REACH_MEANINGS[reach],
    group: 'Pose',
    menu: REACH_MENU,
    section: 1,
    radio: true,
    checked: (wb) => reachShown(wb, currentCharacter(wb)) === reach,
    async run(wb) {
      (await import('./set-reach.ts')).setReach(wb, { reach });
    },
  };
}

export const IK_ACTIONS: readonly Action[] = [
  reachAction('limb', 'ik.reachLimb'),
  reachAction('body', 'ik.reachBody'),
  reachAction('chain', 'ik.reachChain', (wb) => {
    const selected = selectedJoint(wb);
    return `Chain up to ${selected ? jointName(selected.skeleton, selected.joint) : 'the root'}`;
  }),
  {
    id: 'ik.setReach',
    label: 'Switch IK between limb and full body',
    also: 'reach',
    group: 'Pose',
    menu: REACH_MENU,
    section: 2,
    async run(wb, args) {
      (await import('./set-reach.ts')).setReach(wb, args);
    },
  },
  {
    id: 'ik.pinJoint',
    name: 'Pin or unpin selected joints',
    label: (wb) => `${arePinned(wb) ? 'Unpin' : 'Pin'} ${selectedJointsText(wb)}`,
    group: 'Pose',
    menu: MENU,
    section: 1,
    shortcuts: ['Y'],
    refuses: needsJoint,
    explained: true,
    async run(wb) {
      const { togglePins } = await edits();
      const found = selectedJoints(wb);
      if (found) togglePins(wb, found.character, found.joints);
    },
  },
  {
    id: 'ik.lockJoint',
    name: 'Lock selected joints',
    label: (wb) => `Lock ${selectedJointsText(wb)}`,
    group: 'Pose',
    menu: MENU,
    section: 1,
    shortcuts: ['Shift+Y'],
    refuses: needsJoint,
    explained: true,
    checked: areLocked,
    async run(wb) {
      const { toggleLocks } = await edits();
      const found = selectedJoints(wb);
      if (found) toggleLocks(wb, found.character, found.joints);
    },
  },
  {
    id: 'ik.rootFree',
    label: 'Allow root to move',
    detail: 'The whole character moves if a pin needs it',
    group: 'Pose',
    menu: MENU,
    section: 2,
    refuses: needsSkeleton,
    checked: (wb) => ikOfCurrent(wb)?.rootIsFree ?? false,
    async run(wb) {
      const { freeRoot } = await edits();
      const character = currentCharacter(wb);
      const now = ikOfCurrent(wb);
      if (character && now) freeRoot(wb, character.id, !now.rootIsFree);
    },
  },
  {
    id: 'ik.letAllGo',
    label: 'Remove all pins',
    group: 'Pose',
    menu: MENU,
    section: 2,
    refuses: needsPins,
    explained: true,
    async run(wb) {
      const { letAllGo } = await edits();
      const character = currentCharacter(wb);
      if (character) letAllGo(wb, character.id);
    },
  },
  {
    id: 'ik.solve',
    label: 'Re-solve with restarts',
    detail: 'Tries other starting poses when a drag is stuck',
    group: 'Pose',
    menu: MENU,
    section: 3,
    refuses: needsPins,
    explained: true,
    async run(wb) {
      const { solvePins } = await import('./solve-pins.ts');
      const character = currentCharacter(wb);
      if (character) solvePins(wb, character);
    },
  },
  {
    id: 'ik.holdPins',
    label: 'Hold pins over range…',
    detail: 'Foot lock: baked into the take',
    group: 'Pose',
    menu: MENU,
    section: 3,
    refuses: needsPins,
    explained: true,
    run: (wb) => wb.dialog.set('holdPins'),
  },
];
