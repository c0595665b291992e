/**
 * The commands that come with the page's menus, by id. Those for keys, whole curves, samples, takes side by side,
 * retargeting, pins and skeletons come with their editors: with the algorithms they need they are larger than all of
 * these (`all.ts`).
 */
import type { Document } from '../../model/document.ts';
import type { Command, Edit } from '../store.ts';
import {
  addCopy,
  placeCharacter,
  removeCharacter,
  removeCopy,
  renameCharacter,
  setTimeOffset,
  showClip,
  showSkin,
} from './characters.ts';
import { createClip, duplicateClip, removeClip, renameClip, setClipRange, setInterpolation } from './clips.ts';
import { setExtrapolation } from './extrapolation.ts';
import { keyPose } from './keying.ts';
import { clearLimit, setLimit } from './limits.ts';
import { resetPose, setClamping, setDofs } from './pose.ts';
import { setHidden, setPositionChannels, setSpace } from './spaces.ts';
import { discardUnkeyed } from './unkeyed.ts';

/** Arguments are not checked here: each command checks its own and throws a `CommandError`. */
const COMMANDS: readonly Command<never, Document | Edit>[] = [
  setDofs,
  resetPose,
  setClamping,
  discardUnkeyed,
  keyPose,
  createClip,
  renameClip,
  duplicateClip,
  removeClip,
  setClipRange,
  setInterpolation,
  setSpace,
  setPositionChannels,
  setHidden,
  setLimit,
  clearLimit,
  setExtrapolation,
  removeCharacter,
  renameCharacter,
  showSkin,
  showClip,
  setTimeOffset,
  placeCharacter,
  addCopy,
  removeCopy,
];

export const COMMANDS_AT_HAND: ReadonlyMap<string, Command<never, Document | Edit>> = new Map(
  COMMANDS.map((c) => [c.id, c]),
);

/** Ids of the commands loaded on demand. A test compares them with those in `all.ts`. */
export const FETCHED_IDS: ReadonlySet<string> = new Set([
  'keys.insert',
  'keys.add',
  'keys.move',
  'keys.scale',
  'keys.set',
  'keys.snap',
  'keys.remove',
  'keys.ripple',
  'keys.paste',
  'keys.setTangents',
  'keys.setSlopes',
  'keys.unify',
  'keys.break',
  'takes.show',
  'takes.alignStarts',
  'takes.setTimeOffsets',
  'takes.arrange',
  'takes.endOverlay',
  'takes.overlay',
  'takes.remove',
  'takes.mirror',
  'takes.setSpeed',
  'takes.join',
  'takes.cutOut',
  'takes.insert',
  'channels.simplify',
  'channels.resample',
  'channels.eulerFilter',
  'channels.bakeExtrapolation',
  'channels.makeLoop',
  'samples.crop',
  'samples.trim',
  'samples.split',
  'samples.resample',
  'samples.reverse',
  'samples.smooth',
  'samples.convertToKeys',
  'retarget.set',
  'retarget.change',
  'retarget.clear',
  'retarget.bake',
  'poses.mirror',
  'poses.paste',
  'poses.keep',
  'poses.update',
  'poses.rename',
  'poses.remove',
  'poses.apply',
  'poses.add',
  'ik.pin',
  'ik.unpin',
  'ik.clearPins',
  'ik.setPin',
  'ik.setStiffness',
  'ik.setRootFree',
  'hold.pins',
  'rig.create',
  'rig.addJoint',
  'rig.reparent',
  'rig.remove',
  'rig.mirror',
  'rig.rename',
  'rig.setOffset',
  'rig.setMotion',
  'rig.setBox',
  'rig.setLength',
  'rig.setFilePose',
  'rig.setCouple',
  'rig.setLimit',
  'rig.clearLimit',
  'skin.autoWeights',
  'characters.sameHeight',
  'characters.ownHeights',
]);
