/** Actions on whole poses: copy, paste, mirror, save. Their scripts are loaded on first use. */

import { boolean, optional, record } from '../../../edit/schema/shape.ts';
import type { NamedPose } from '../../../model/poses.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { needs, needsCharacter, needsJoint, needsSkeleton } from '../../state/actions/needs.ts';
import { selectedJointsText } from '../../state/joints/selected-joint.ts';
import type { Action, Uses } from '../../state/workbench.ts';

const MENU = 'Edit/Pose';
const edits = () => import('./pose-edits.ts');

/** In the library of the current character. */
export function focusedPose(wb: Uses<'store' | 'posing'>): NamedPose | undefined {
  return currentCharacter(wb)?.poses?.[wb.posing.libraryPose.get()];
}

const LIVE_MIRROR = record({ on: optional(boolean) });

/** Arguments of scripts; keys and menus give none. */
function liveMirrorArgs(args: unknown): { readonly on?: boolean } {
  return typeof args === 'object' && args !== null ? LIVE_MIRROR.read(args, '') : {};
}

export const POSE_ACTIONS: readonly Action[] = [
  {
    id: 'pose.copy',
    label: 'Copy pose',
    group: 'Edit',
    menu: MENU,
    section: 1,
    shortcuts: ['Ctrl+Shift+C'],
    refuses: needsCharacter,
    run: async (wb) => (await edits()).copyPose(wb),
  },
  {
    id: 'pose.paste',
    name: 'Paste pose',
    label(wb) {
      const from = wb.posing.copied.get()?.from;
      return from === undefined || from === currentCharacter(wb)?.name ? 'Paste pose' : `Paste pose of ${from}`;
    },
    group: 'Edit',
    menu: MENU,
    section: 1,
    shortcuts: ['Ctrl+Shift+V'],
    refuses: needs(
      (wb) => needsCharacter(wb) ?? 'Copy a pose first.',
      (wb) => !needsCharacter(wb) && wb.posing.copied.get() !== undefined,
    ),
    run: async (wb) => (await edits()).pasteCopied(wb),
  },
  {
    id: 'pose.copyJoints',
    name: 'Copy pose of selected joints',
    label: (wb) => `Copy pose of ${selectedJointsText(wb)}`,
    detail: 'Pasting it changes only these',
    group: 'Edit',
    menu: MENU,
    section: 1,
    refuses: needsJoint,
    run: async (wb) => (await edits()).copyJoints(wb),
  },
  {
    id: 'pose.resetJoints',
    name: 'Reset selected joints to file pose',
    label: (wb) => `Reset ${selectedJointsText(wb)} to file pose`,
    unchanged: 'The selected joints are already in the file pose.',
    group: 'Edit',
    menu: MENU,
    section: 1,
    shortcuts: ['Alt+Shift+R'],
    refuses: needsJoint,
    run: async (wb) => (await edits()).resetJoints(wb),
  },
  {
    id: 'pose.pasteFlipped',
    label: 'Paste pose flipped',
    detail: 'Swaps left and right',
    also: 'mirror',
    group: 'Edit',
    menu: MENU,
    section: 1,
    shortcuts: ['Ctrl+Alt+V'],
    refuses: needs(
      (wb) => needsCharacter(wb) ?? 'Copy a pose first.',
      (wb) => !needsCharacter(wb) && wb.posing.copied.get() !== undefined,
    ),
    run: async (wb) => (await edits()).pasteCopied(wb, true),
  },
  {
    id: 'pose.mirror',
    label: 'Mirror pose',
    detail: 'Swaps left and right',
    group: 'Edit',
    menu: MENU,
    section: 2,
    shortcuts: ['Alt+M'],
    refuses: needsSkeleton,
    run: async (wb) => (await edits()).mirror(wb, 'swap', false),
  },
  {
    id: 'pose.mirrorBranch',
    name: 'Mirror pose of selected joints',
    label: (wb) => `Mirror pose of ${selectedJointsText(wb)}`,
    detail: 'Including all descendants',
    group: 'Edit',
    menu: MENU,
    section: 2,
    refuses: needsJoint,
    run: async (wb) => (await edits()).mirror(wb, 'swap', true),
  },
  {
    id: 'pose.copyToOther',
    name: 'Copy pose of selected joints to other side',
    label: (wb) => `Copy ${selectedJointsText(wb)} to other side`,
    group: 'Edit',
    menu: MENU,
    section: 2,
    shortcuts: ['Alt+Shift+M'],
    refuses: needsJoint,
    run: async (wb) => (await edits()).mirror(wb, 'toOther', true),
  },
  {
    id: 'pose.liveMirror',
    label: 'Live mirror',
    detail: 'Both sides at once',
    also: 'symmetry symmetric',
    group: 'Pose',
    menu: MENU,
    section: 2,
    shortcuts: ['Ctrl+Alt+M'],
    checked: (wb) => wb.posing.mirrored.get() !== undefined,
    async run(wb, args) {
      const { mirroredSetDofs } = await import('../../../edit/pose/live-mirror.ts');
      const { on = wb.posing.mirrored.get() === undefined } = liveMirrorArgs(args);
      wb.posing.mirrored.set(on ? mirroredSetDofs : undefined);
    },
  },
  {
    id: 'pose.keep',
    label: 'Save to pose library',
    detail: 'Keeps the current pose for this character',
    group: 'Edit',
    menu: MENU,
    section: 3,
    shortcuts: ['Alt+P'],
    refuses: needsCharacter,
    run: async (wb) => (await edits()).keep(wb),
  },
  {
    id: 'pose.update',
    name: 'Update focused pose in library',
    label(wb) {
      const pose = focusedPose(wb);
      return pose ? `Update ${pose.name} in library` : 'Update pose in library';
    },
    detail: 'Replaces the focused pose with the current one',
    unchanged: 'The pose is already saved like this.',
    group: 'Edit',
    menu: MENU,
    section: 3,
    refuses: needs('The character has no saved poses.', (wb) => focusedPose(wb) !== undefined),
    async run(wb) {
      const { update } = await edits();
      const character = currentCharacter(wb);
      if (character) update(wb, character.id, wb.posing.libraryPose.get());
    },
  },
];
