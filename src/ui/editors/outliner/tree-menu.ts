/** Entries of a joint's context menu that change the skeleton. */
import { possibleParents } from '../../../edit/rig/parents.ts';
import type { Character } from '../../../model/document.ts';
import { jointName } from '../../../model/joint-name.ts';
import { isMac } from '../../kit/keyboard.ts';
import type { MenuEntry } from '../../kit/menu.ts';
import { findAction, runAction } from '../../state/action.ts';
import { ariaShortcut, shortcutsFor, shortcutText } from '../../state/shortcuts.ts';
import type { Workbench } from '../../state/workbench.ts';

const edits = () => import('../rig/rig-edits.ts');

/**
 * All of them in rig mode; otherwise only renaming and switching to rig mode.
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
  const select = () => wb.store.select({ characterId: character.id, joint });
  if (wb.posing.mode.get() !== 'rig') {
    const rig = () => {
      select();
      runAction(wb, 'posing.rig');
    };
    const ofSelected = (id: string) => () => {
      select();
      runAction(wb, id);
    };
    const { pins = [], stiff = [] } = character.ik ?? {};
    const isPinned = pins.some((pin) => pin.joint === joint);
    const isLocked = stiff.some((one) => one.joint === joint && one.stiffness === undefined);
    return [
      // The tree's own key.
      item('Rename', rename, 'F2'),
      item(isPinned ? 'Unpin (IK)' : 'Pin (IK)', ofSelected('ik.pinJoint'), keyOf('ik.pinJoint')),
      item(isLocked ? 'Unlock (IK)' : 'Lock (IK)', ofSelected('ik.lockJoint'), keyOf('ik.lockJoint')),
      item('Edit in rig mode', rig),
    ];
  }
  const doing = (label: string, run: (module: Awaited<ReturnType<typeof edits>>) => void, shortcut?: string) =>
    item(label, () => void edits().then(run), shortcut);
  const joints = character.skeleton?.joints ?? [];
  const nameOf = (j: number) => jointName(character.skeleton, j);
  const parents: MenuEntry = {
    kind: 'menu',
    label: 'Parent to',
    entries: () => [
      ...possibleParents(joints, joint).map(
        (parent): MenuEntry => ({
          kind: 'item',
          label: nameOf(parent),
          detail: undefined,
          enabled: true,
          radio: true,
          checked: parent === joints[joint].parent,
          run: () => void edits().then((m) => m.moveUnder(wb, character.id, { joint, parent })),
        }),
      ),
    ],
  };
  const isRoot = joint === 0;
  return [
    item('Rename', rename, keyOf('rigging.rename')),
    doing('Add child', (m) => m.addChild(wb, joint), keyOf('rigging.addChild')),
    item('Add joints by clicking', () => {
      select();
      wb.posing.rig.adding.set(true);
    }),
    doing('Mirror hierarchy across x', (m) => m.mirrorIt(wb, 'x', joint), keyOf('rigging.mirror.x')),
    ...(isRoot ? [] : [parents]),
    { kind: 'line' },
    doing('Delete, keep children', (m) => m.removeIt(wb, 'stay', joint), keyOf('rigging.delete')),
    doing('Delete with descendants', (m) => m.removeIt(wb, 'too', joint), keyOf('rigging.deleteBranch')),
    { kind: 'line' },
  ];
}
