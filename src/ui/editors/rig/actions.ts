/** Actions that build and edit skeletons. Loaded on first use; their shortcuts work in rig mode only. */

import { AXIS_LETTERS } from '../../../model/skeleton/dof-axis.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { needsJoint, needsSkeleton } from '../../state/actions/needs.ts';
import { selectedJointsText } from '../../state/joints/selected-joint.ts';
import { isPanelOpen, openPanel } from '../../state/panels/panels.ts';
import type { Action, Uses } from '../../state/workbench.ts';

const edits = () => import('./rig-edits.ts');

const inRigMode = (wb: Uses<'posing'>) => wb.posing.mode.get() === 'rig';

function inRig(action: Action): Action {
  return {
    ...action,
    refuses: (wb) => (inRigMode(wb) ? action.refuses?.(wb) : 'Switch to rig mode first.'),
  };
}

/** For the selected joints. */
function ofJoint(action: Omit<Action, 'group' | 'menu'> & Partial<Action>): Action {
  return inRig({
    group: 'Rig',
    menu: 'Rig',
    ...action,
    refuses: needsJoint,
    explained: true,
  });
}

export const RIG_ACTIONS: readonly Action[] = [
  {
    id: 'rigging.mode',
    label: 'Rig mode',
    detail: 'Edit joints with handles in the viewport',
    group: 'Rig',
    menu: 'Rig',
    checked: inRigMode,
    run: (wb) => wb.posing.mode.update((now) => (now === 'rig' ? 'pose' : 'rig')),
  },
  {
    id: 'rigging.new',
    label: 'New skeleton',
    detail: 'Starts with one joint; click to add more',
    group: 'Rig',
    menu: 'Rig',
    alsoIn: { menu: 'Open' },
    run: async (wb) => (await edits()).newSkeleton(wb),
  },
  inRig({
    id: 'rigging.addJoints',
    label: 'Add joints by clicking',
    group: 'Rig',
    menu: 'Rig',
    section: 1,
    shortcuts: ['Shift+A'],
    checked: (wb) => wb.posing.rig.adding.get(),
    run(wb) {
      wb.posing.rig.adding.update((on) => !on);
      const character = currentCharacter(wb);
      // Selects a parent for the first click.
      if (wb.posing.rig.adding.get() && character?.skeleton && needsJoint(wb)) {
        wb.store.select({ characterId: character.id, joint: 0 });
      }
    },
  }),
  ofJoint({
    id: 'rigging.addChild',
    label: 'Add child',
    section: 1,
    shortcuts: ['Shift+C'],
    run: async (wb) => (await edits()).addChild(wb),
  }),
  ofJoint({
    id: 'rigging.rename',
    label: 'Rename joint',
    section: 2,
    shortcuts: ['F2'],
    run(wb) {
      // Renaming happens in its row.
      if (!isPanelOpen(wb.settings.get(), 'outliner')) openPanel(wb, 'outliner', true);
      wb.posing.rig.renameAsked.update((times) => times + 1);
    },
  }),
  ...AXIS_LETTERS.map((axis) =>
    ofJoint({
      id: `rigging.mirror.${axis}`,
      name: `Mirror hierarchy across ${axis}`,
      label: axis === 'x' ? 'Across x: left and right' : `Across ${axis}`,
      menu: 'Rig/Mirror hierarchy',
      section: 2,
      ...(axis === 'x' && { shortcuts: ['Shift+M'] }),
      run: async (wb) => (await edits()).mirrorSelected(wb, axis),
    }),
  ),
  ofJoint({
    id: 'rigging.delete',
    name: 'Delete joints, keep children',
    label: (wb) => `Delete ${selectedJointsText(wb)}, keep children`,
    section: 3,
    shortcuts: ['Delete'],
    run: async (wb) => (await edits()).removeSelected(wb, 'stay'),
  }),
  ofJoint({
    id: 'rigging.deleteBranch',
    name: 'Delete joints and descendants',
    label: (wb) => `Delete ${selectedJointsText(wb)} and descendants`,
    section: 3,
    shortcuts: ['Shift+Delete'],
    run: async (wb) => (await edits()).removeSelected(wb, 'too'),
  }),
  inRig({
    id: 'rigging.skinStays',
    label: 'Keep skin in place',
    detail: 'Rebinds the skin. Otherwise it follows the joints',
    group: 'Rig',
    menu: 'Rig',
    section: 4,
    shortcuts: ['Shift+S'],
    checked: (wb) => wb.posing.rigSkin.get() === 'stays',
    run: (wb) => wb.posing.rigSkin.update((now) => (now === 'stays' ? 'follows' : 'stays')),
  }),
  inRig({
    id: 'rigging.childrenStay',
    label: 'Keep children in place',
    group: 'Rig',
    menu: 'Rig',
    section: 4,
    checked: (wb) => wb.posing.rig.children.get() === 'stay',
    run: (wb) => wb.posing.rig.children.update((now) => (now === 'stay' ? 'follow' : 'stay')),
  }),
  inRig({
    id: 'rigging.worldAxes',
    label: 'World-axis handles',
    detail: 'Otherwise handles follow the parent’s axes, as offsets do',
    group: 'Rig',
    menu: 'Rig',
    section: 4,
    checked: (wb) => wb.posing.rig.axes.get() === 'world',
    run: (wb) => wb.posing.rig.axes.update((now) => (now === 'world' ? 'parent' : 'world')),
  }),
  inRig({
    id: 'rigging.snapToGrid',
    label: 'Snap to grid',
    detail: 'Joints and boxes. Hold Shift to place them freely',
    group: 'Rig',
    menu: 'Rig',
    section: 4,
    checked: (wb) => wb.settings.get().snapsToGrid,
    run: (wb) => wb.settings.update((s) => ({ ...s, snapsToGrid: !s.snapsToGrid })),
  }),
  inRig({
    id: 'rigging.filePose',
    label: 'Set current pose as file pose',
    group: 'Rig',
    menu: 'Rig',
    section: 5,
    refuses: needsSkeleton,
    run: async (wb) => (await edits()).takeFilePose(wb, 'shown'),
  }),
  inRig({
    id: 'rigging.filePoseRest',
    label: 'Set file pose to zero',
    group: 'Rig',
    menu: 'Rig',
    section: 5,
    refuses: needsSkeleton,
    run: async (wb) => (await edits()).takeFilePose(wb, 'rest'),
  }),
];
