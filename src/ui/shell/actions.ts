/**
 * The single list of everything the page can do, assembled from the lists of its editors. Menus, shortcuts, the `?`
 * page and the command search are all built from it, so that they can't contradict each other.
 */

import { ATTACH_ACTIONS } from '../editors/attach/actions.ts';
import { COMPARE_ACTIONS } from '../editors/compare/actions.ts';
import { DOPE_ACTIONS } from '../editors/dope/actions.ts';
import { IK_ACTIONS } from '../editors/ik/actions.ts';
import { LAYER_ACTIONS } from '../editors/layers/actions.ts';
import { LIMB_ACTIONS } from '../editors/limbs/actions.ts';
import { POSE_ACTIONS } from '../editors/poses/actions.ts';
import { POSING_ACTIONS } from '../editors/posing/actions.ts';
import { KEYING_ACTIONS } from '../editors/posing/keying-actions.ts';
import { RETARGET_ACTIONS } from '../editors/retarget/actions.ts';
import { REVIEW_ACTIONS } from '../editors/review/actions.ts';
import { RIG_ACTIONS } from '../editors/rig/actions.ts';
import { SET_ACTIONS } from '../editors/sets/actions.ts';
import { SKIN_ACTIONS } from '../editors/skin/actions.ts';
import { TAKE_ACTIONS } from '../editors/takes/actions.ts';
import { TIMELINE_ACTIONS } from '../editors/timeline/actions.ts';
import { KEY_ACTIONS } from '../editors/timeline/key-actions.ts';
import { PLAY_ACTIONS } from '../editors/transport/actions.ts';
import { TWEEN_ACTIONS } from '../editors/tween/actions.ts';
import { VIEW_ACTIONS } from '../editors/viewport/actions.ts';
import type { Action, Workbench } from '../state/workbench.ts';
import { EDIT_ACTIONS } from './edit-actions.ts';
import { FILE_ACTIONS, keptActions, sampleActions } from './file-actions.ts';
import { offlineActions, PAGE_ACTIONS } from './page-actions.ts';
import { SELECT_ACTIONS } from './select-actions.ts';
import { UNDO_MEMORY_ACTIONS } from './undo-memory.ts';

/** Static actions, in menu order. */
export const ACTIONS: readonly Action[] = [
  ...FILE_ACTIONS,
  ...COMPARE_ACTIONS,
  ...EDIT_ACTIONS,
  ...SELECT_ACTIONS,
  ...SET_ACTIONS,
  ...POSE_ACTIONS,
  ...POSING_ACTIONS,
  ...IK_ACTIONS,
  ...LIMB_ACTIONS,
  ...RETARGET_ACTIONS,
  ...ATTACH_ACTIONS,
  ...SKIN_ACTIONS,
  ...UNDO_MEMORY_ACTIONS,
  ...RIG_ACTIONS,
  ...KEYING_ACTIONS,
  ...LAYER_ACTIONS,
  ...KEY_ACTIONS,
  ...TWEEN_ACTIONS,
  ...TIMELINE_ACTIONS,
  ...DOPE_ACTIONS,
  ...VIEW_ACTIONS,
  ...PLAY_ACTIONS,
  ...TAKE_ACTIONS,
  ...REVIEW_ACTIONS,
  ...PAGE_ACTIONS,
];

/** All current actions, including examples, sessions left by an earlier page, and new versions. */
export function pageActions(wb: Workbench): readonly Action[] {
  return [...ACTIONS, ...keptActions(wb), ...sampleActions(wb), ...offlineActions(wb)];
}
