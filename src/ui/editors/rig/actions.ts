/** Building and changing skeletons. What does it is fetched when it is asked for; keys hold in rig mode only. */
import type { Axis } from '../../../edit/rig/rigging.ts';
import { currentCharacter } from '../../state/action.ts';
import { isPanelOpen, openPanel } from '../../state/panels.ts';
import { selectedJoint } from '../../state/selected-joint.ts';
import type { Action, Workbench } from '../../state/workbench.ts';

const edits = () => import('./rig-edits.ts');

const inRigMode = (wb: Workbench) => wb.posing.mode.get() === 'rig';
const hasSkeleton = (wb: Workbench) => currentCharacter(wb)?.skeleton !== undefined;
const hasJoint = (wb: Workbench) => selectedJoint(wb) !== undefined;

function inRig(action: Action): Action {
  return {
    ...action,
    enabled: (wb) => inRigMode(wb) && (action.enabled?.(wb) ?? true),
    whyNot: (wb) => (inRigMode(wb) ? action.whyNot?.(wb) : undefined),
  };
}

/** Of the selected joint. */
function ofJoint(action: Omit<Action, 'group' | 'menu'> & Partial<Action>): Action {
  return inRig({
    group: 'Rig',
    menu: 'Rig',
    ...action,
    enabled: hasJoint,
    whyNot: (wb) => (hasJoint(wb) ? undefined : 'Select a joint first'),
  });
}

export const RIG_ACTIONS: readonly Action[] = [
  {
    id: 'rigging.mode',
    label: 'Rig mode',
    detail: 'Joints are handles; most of this menu is for it',
    group: 'Rig',
    menu: 'Rig',
    checked: inRigMode,
    run: (wb) => wb.posing.mode.update((now) => (now === 'rig' ? 'fk' : 'rig')),
  },
  {
    id: 'rigging.new',
    label: 'New skeleton',
    detail: 'From nothing: one joint, and a click for each further one',
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
      // There is something for the first click to hang on, and one sees what.
      if (wb.posing.rig.adding.get() && character?.skeleton && !hasJoint(wb)) {
        wb.store.select({ characterId: character.id, joint: 0 });
      }
    },
  }),
  ofJoint({
    id: 'rigging.addChild',
    label: 'Add a child',
    section: 1,
    shortcuts: ['Shift+C'],
    run: async (wb) => (await edits()).addChild(wb),
  }),
  ofJoint({
    id: 'rigging.rename',
    label: 'Rename the joint',
    section: 2,
    shortcuts: ['F2'],
    run(wb) {
      // The name is typed in its row.
      if (!isPanelOpen(wb.settings.get(), 'outliner')) openPanel(wb, 'outliner', true);
      wb.posing.rig.renameAsked.update((times) => times + 1);
    },
  }),
  ...(['x', 'y', 'z'] as const).map((axis: Axis) =>
    ofJoint({
      id: `rigging.mirror.${axis}`,
      name: `Mirror the branch across ${axis}`,
      label: axis === 'x' ? 'Across x: left and right' : `Across ${axis}`,
      menu: 'Rig/Mirror the branch',
      section: 2,
      ...(axis === 'x' && { shortcuts: ['Shift+M'] }),
      run: async (wb) => (await edits()).mirrorIt(wb, axis),
    }),
  ),
  ofJoint({
    id: 'rigging.delete',
    label: 'Delete the joint; its children stay',
    section: 3,
    shortcuts: ['Delete'],
    run: async (wb) => (await edits()).removeIt(wb, 'stay'),
  }),
  ofJoint({
    id: 'rigging.deleteBranch',
    label: 'Delete the joint and all below it',
    section: 3,
    shortcuts: ['Shift+Delete'],
    run: async (wb) => (await edits()).removeIt(wb, 'too'),
  }),
  inRig({
    id: 'rigging.skinStays',
    label: 'Skin stays where it is',
    detail: 'Bind mode; otherwise it follows the joints, as if posed',
    group: 'Rig',
    menu: 'Rig',
    section: 4,
    shortcuts: ['Shift+S'],
    checked: (wb) => wb.posing.rigSkin.get() === 'stays',
    run: (wb) => wb.posing.rigSkin.update((now) => (now === 'stays' ? 'follows' : 'stays')),
  }),
  inRig({
    id: 'rigging.childrenStay',
    label: 'Children stay when a joint is dragged',
    group: 'Rig',
    menu: 'Rig',
    section: 4,
    checked: (wb) => wb.posing.rig.children.get() === 'stay',
    run: (wb) => wb.posing.rig.children.update((now) => (now === 'stay' ? 'follow' : 'stay')),
  }),
  inRig({
    id: 'rigging.worldAxes',
    label: 'Arrows along the world’s axes',
    detail: 'Otherwise along the parent’s, as offsets count',
    group: 'Rig',
    menu: 'Rig',
    section: 4,
    checked: (wb) => wb.posing.rig.axes.get() === 'world',
    run: (wb) => wb.posing.rig.axes.update((now) => (now === 'world' ? 'parent' : 'world')),
  }),
  inRig({
    id: 'rigging.filePose',
    label: 'Take the pose shown as the file’s pose',
    group: 'Rig',
    menu: 'Rig',
    section: 5,
    enabled: hasSkeleton,
    run: async (wb) => (await edits()).takeFilePose(wb, 'shown'),
  }),
  inRig({
    id: 'rigging.filePoseRest',
    label: 'Make the file’s pose all zero',
    group: 'Rig',
    menu: 'Rig',
    section: 5,
    enabled: hasSkeleton,
    run: async (wb) => (await edits()).takeFilePose(wb, 'rest'),
  }),
];
