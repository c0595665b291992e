/** Entries of a joint's context menu that change the skeleton. */
import { possibleParents } from '../../../edit/rig/parents.ts';
import type { Character } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { withJointToggled } from '../../../model/skeleton/selected-joints.ts';
import { findAction, tryById } from '../../state/actions/action.ts';
import { jointsText, selectedJointsOf } from '../../state/joints/selected-joint.ts';
import { ariaShortcut, shortcutsFor, shortcutText } from '../../state/shortcuts.ts';
import type { Workbench } from '../../state/workbench.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import type { MenuEntry } from '../../widgets/menu.ts';

const ADD = 'Add to selection';
const REMOVE = 'Remove from selection';

const edits = () => import('../rig/rig-edits.ts');

/**
 * All of them in rig mode; otherwise renaming, pins and switching to rig mode. On one of several selected joints they
 * are for all of these, except for what only one can have.
 *
 * @param joint index of the row's joint, which may not be selected yet
 */
export function jointEntries(
  wb: Workbench,
  character: Character,
  joint: number,
  rename: () => void,
): readonly MenuEntry[] {
  const item = (label: string, run: () => void, shortcut?: string): MenuEntry => ({
    kind: 'item',
    label,
    enabled: true,
    shortcut: shortcut && shortcutText(shortcut, isMac),
    ariaShortcut: shortcut && ariaShortcut(shortcut, isMac),
    run,
  });
  /** Shortcut of the action that does the same to the selected joint. */
  const keyOf = (id: string): string | undefined => {
    const action = findAction(wb, id);
    return action && shortcutsFor(action, wb.settings.get())[0];
  };
  const selected = selectedJointsOf(wb, character.id);
  const isSelected = selected.includes(joint);
  const joints = isSelected ? selected : [joint];
  const isForSeveral = joints.length > 1;
  const select = () => {
    if (!isSelected) wb.store.select({ characterId: character.id, joint });
  };
  // A finger has no Shift or Ctrl.
  const adding: MenuEntry[] =
    selected.length > (isSelected ? 1 : 0)
      ? [
          item(isSelected ? REMOVE : ADD, () =>
            wb.store.select(withJointToggled(wb.store.selection, { characterId: character.id, joint })),
          ),
        ]
      : [];
  /** `Pin 3 joints (IK)`, `Pin (IK)` for one. */
  const what = isForSeveral ? ` ${jointsText(character.skeleton, joints)}` : '';
  if (wb.posing.mode.get() !== 'rig') {
    const rig = () => {
      select();
      tryById(wb, 'posing.rig');
    };
    const ofSelected = (id: string) => () => {
      select();
      tryById(wb, id);
    };
    const { pins = [], stiff = [] } = character.ik ?? {};
    const arePinned = joints.every((j) => pins.some((pin) => pin.joint === j));
    const areLocked = joints.every((j) => stiff.some((one) => one.joint === j && one.stiffness === undefined));
    return [
      // The tree's own key.
      item('Rename', rename, 'F2'),
      ...adding,
      item(`${arePinned ? 'Unpin' : 'Pin'}${what} (IK)`, ofSelected('ik.pinJoint'), keyOf('ik.pinJoint')),
      item(`${areLocked ? 'Unlock' : 'Lock'}${what} (IK)`, ofSelected('ik.lockJoint'), keyOf('ik.lockJoint')),
      item('Edit in rig mode', rig),
    ];
  }
  const doing = (label: string, run: (module: Awaited<ReturnType<typeof edits>>) => void, shortcut?: string) =>
    item(
      label,
      () => {
        select();
        void edits().then(run);
      },
      shortcut,
    );
  const all = character.skeleton?.joints ?? [];
  const nameOf = (j: number) => jointName(character.skeleton, j);
  const parents: MenuEntry = {
    kind: 'menu',
    label: 'Parent to',
    entries: () => [
      ...possibleParents(all, joint).map(
        (parent): MenuEntry => ({
          kind: 'item',
          label: nameOf(parent),
          detail: undefined,
          enabled: true,
          radio: true,
          checked: parent === all[joint].parent,
          run: () => void edits().then((m) => m.moveUnder(wb, character.id, { joint, parent })),
        }),
      ),
    ],
  };
  const oneParent: MenuEntry = {
    kind: 'item',
    label: 'Parent to',
    detail: 'Select one joint',
    enabled: false,
    run: () => {},
  };
  const isRoot = joints.includes(0);
  return [
    item('Rename', rename, keyOf('rigging.rename')),
    ...adding,
    doing(
      isForSeveral ? `Add child to ${nameOf(joints[joints.length - 1])}` : 'Add child',
      (m) => m.addChild(wb),
      keyOf('rigging.addChild'),
    ),
    item('Add joints by clicking', () => {
      select();
      wb.posing.rig.adding.set(true);
    }),
    doing('Mirror hierarchy across x', (m) => m.mirrorSelected(wb, 'x'), keyOf('rigging.mirror.x')),
    ...(isRoot ? [] : [isForSeveral ? oneParent : parents]),
    { kind: 'line' },
    doing(`Delete${what}, keep children`, (m) => m.removeSelected(wb, 'stay'), keyOf('rigging.delete')),
    doing(`Delete${what} with descendants`, (m) => m.removeSelected(wb, 'too'), keyOf('rigging.deleteBranch')),
    { kind: 'line' },
  ];
}
