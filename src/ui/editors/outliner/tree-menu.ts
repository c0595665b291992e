/** Entries of a joint's context menu that change the skeleton. */
import { possibleParents } from '../../../edit/rig/parents.ts';
import type { Character } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { withJointToggled } from '../../../model/skeleton/joint-selection.ts';
import { jointsIn, partsOf } from '../../../model/skeleton/selected-joints.ts';
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
  const selected = selectedJointsOf(wb, character.id);
  const isSelected = selected.includes(joint);
  const count = partsOf(wb.store.selection).flatMap(jointsIn).length;
  const toggle = () => wb.store.select(withJointToggled(wb.store.selection, { characterId: character.id, joint }));
  const of: OfJoints = {
    ...{ wb, character, joint, rename },
    joints: isSelected ? selected : [joint],
    // A finger has no Shift or Ctrl.
    adding: count > (isSelected ? 1 : 0) ? [item(isSelected ? REMOVE : ADD, toggle)] : [],
    select() {
      if (!isSelected) wb.store.select({ characterId: character.id, joint });
    },
  };
  return wb.posing.mode.get() === 'rig' ? entriesOfRig(of) : entriesOfPoses(of);
}

interface OfJoints {
  readonly wb: Workbench;
  readonly character: Character;
  /** The row's. */
  readonly joint: number;
  readonly joints: readonly number[];
  readonly adding: readonly MenuEntry[];
  rename(): void;
  /** Selects the row's joint, if it isn't. */
  select(): void;
}

function entriesOfPoses({ wb, character, joints, adding, rename, select }: OfJoints): readonly MenuEntry[] {
  const ofSelected = (id: string) => () => {
    select();
    tryById(wb, id);
  };
  const what = whatOf(character, joints);
  const { pins = [], stiff = [] } = character.ik ?? {};
  const arePinned = joints.every((j) => pins.some((pin) => pin.joint === j));
  const areLocked = joints.every((j) => stiff.some((one) => one.joint === j && one.stiffness === undefined));
  return [
    // The tree's own key.
    item('Rename', rename, 'F2'),
    ...adding,
    item(`${arePinned ? 'Unpin' : 'Pin'}${what} (IK)`, ofSelected('ik.pinJoint'), keyOf(wb, 'ik.pinJoint')),
    item(`${areLocked ? 'Unlock' : 'Lock'}${what} (IK)`, ofSelected('ik.lockJoint'), keyOf(wb, 'ik.lockJoint')),
    item('Edit in rig mode', ofSelected('posing.rig')),
  ];
}

function entriesOfRig({ wb, character, joint, joints, adding, rename, select }: OfJoints): readonly MenuEntry[] {
  const doing = (label: string, run: (module: Awaited<ReturnType<typeof edits>>) => void, id: string) => {
    const start = () => {
      select();
      void edits().then(run);
    };
    return item(label, start, keyOf(wb, id));
  };
  const isForSeveral = joints.length > 1;
  const what = whatOf(character, joints);
  const last = jointName(character.skeleton, joints[joints.length - 1]);
  return [
    item('Rename', rename, keyOf(wb, 'rigging.rename')),
    ...adding,
    doing(isForSeveral ? `Add child to ${last}` : 'Add child', (m) => m.addChild(wb), 'rigging.addChild'),
    item('Add joints by clicking', () => {
      select();
      wb.posing.rig.adding.set(true);
    }),
    doing('Mirror hierarchy across x', (m) => m.mirrorSelected(wb, 'x'), 'rigging.mirror.x'),
    ...(joints.includes(0) ? [] : [isForSeveral ? ONE_PARENT : parentsOf(wb, character, joint)]),
    { kind: 'line' },
    doing(`Delete${what}, keep children`, (m) => m.removeSelected(wb, 'stay'), 'rigging.delete'),
    doing(`Delete${what} with descendants`, (m) => m.removeSelected(wb, 'too'), 'rigging.deleteBranch'),
    { kind: 'line' },
  ];
}

const ONE_PARENT: MenuEntry = {
  kind: 'item',
  label: 'Parent to',
  detail: 'Select one joint',
  enabled: false,
  run: () => {},
};

function parentsOf(wb: Workbench, { id, skeleton }: Character, joint: number): MenuEntry {
  const all = skeleton?.joints ?? [];
  const entries = () =>
    possibleParents(all, joint).map(
      (parent): MenuEntry => ({
        kind: 'item',
        label: jointName(skeleton, parent),
        detail: undefined,
        enabled: true,
        radio: true,
        checked: parent === all[joint].parent,
        run: () => void edits().then((m) => m.moveUnder(wb, id, { joint, parent })),
      }),
    );
  return { kind: 'menu', label: 'Parent to', entries };
}

function item(label: string, run: () => void, shortcut?: string): MenuEntry {
  return {
    kind: 'item',
    label,
    enabled: true,
    shortcut: shortcut && shortcutText(shortcut, isMac),
    ariaShortcut: shortcut && ariaShortcut(shortcut, isMac),
    run,
  };
}

/** Shortcut of the action that does the same to the selected joint. */
function keyOf(wb: Workbench, id: string): string | undefined {
  const action = findAction(wb, id);
  return action && shortcutsFor(action, wb.settings.get())[0];
}

/** ` 3 joints`; empty for one. */
function whatOf({ skeleton }: Character, joints: readonly number[]): string {
  return joints.length > 1 ? ` ${jointsText(skeleton, joints)}` : '';
}
