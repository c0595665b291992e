/** Actions of inverse kinematics: pins, joint locks, root motion. Their scripts are loaded on first use. */

import { defaultIk } from '../../../model/ik.ts';
import { currentCharacter } from '../../state/action.ts';
import { NO_SKELETON, needs } from '../../state/needs.ts';
import { selectedJoint } from '../../state/selected-joint.ts';
import type { Action, Uses } from '../../state/workbench.ts';

const MENU = 'Edit/Pins';
const edits = () => import('./pin-edits.ts');
const ikOfCurrent = (wb: Uses<'store'>) => {
  const character = currentCharacter(wb);
  return character?.skeleton && (character.ik ?? defaultIk(character.skeleton));
};
const hasPins = (wb: Uses<'store'>) => (ikOfCurrent(wb)?.pins.length ?? 0) > 0;
const NO_PINS = 'The character has no pins.';
const NO_JOINT = 'No joint is selected.';

const hasJoint = (wb: Uses<'store'>) => selectedJoint(wb) !== undefined;
const isPinned = (wb: Uses<'store'>) => {
  const joint = selectedJoint(wb)?.joint;
  return ikOfCurrent(wb)?.pins.some((pin) => pin.joint === joint) ?? false;
};
const isLocked = (wb: Uses<'store'>) => {
  const joint = selectedJoint(wb)?.joint;
  return ikOfCurrent(wb)?.stiff.some((one) => one.joint === joint && one.stiffness === undefined) ?? false;
};

export const IK_ACTIONS: readonly Action[] = [
  {
    id: 'ik.pinJoint',
    name: 'Pin or unpin selected joint',
    label: (wb) => (isPinned(wb) ? 'Unpin selected joint' : 'Pin selected joint'),
    group: 'Pose',
    menu: MENU,
    section: 1,
    shortcuts: ['Y'],
    enabled: hasJoint,
    whyNot: () => NO_JOINT,
    async run(wb) {
      const { togglePin } = await edits();
      const found = selectedJoint(wb);
      if (found) togglePin(wb, found.character, found.joint);
    },
  },
  {
    id: 'ik.lockJoint',
    label: 'Lock selected joint',
    group: 'Pose',
    menu: MENU,
    section: 1,
    shortcuts: ['Shift+Y'],
    enabled: hasJoint,
    whyNot: () => NO_JOINT,
    checked: isLocked,
    async run(wb) {
      const { toggleLock } = await edits();
      const found = selectedJoint(wb);
      if (found) toggleLock(wb, found.character, found.joint);
    },
  },
  {
    id: 'ik.rootFree',
    label: 'Allow root to move',
    detail: 'The whole character moves when a pin needs it',
    group: 'Pose',
    menu: MENU,
    section: 2,
    enabled: needs(NO_SKELETON, (wb) => ikOfCurrent(wb) !== undefined),
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
    enabled: hasPins,
    whyNot: () => NO_PINS,
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
    enabled: hasPins,
    whyNot: () => NO_PINS,
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
    enabled: hasPins,
    whyNot: () => NO_PINS,
    run: (wb) => wb.dialog.set('holdPins'),
  },
];
