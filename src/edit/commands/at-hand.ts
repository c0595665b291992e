/**
 * The commands that come with the page's menus, each with the arguments that it takes from scripts. Those for keys,
 * whole curves, samples, takes side by side, retargeting, pins and skeletons come with their editors: with the
 * algorithms they need they are larger than all of these (`all.ts`).
 */
import { INTERPOLATIONS } from '../../model/samples.ts';
import { LENGTH_UNITS } from '../../model/space.ts';
import {
  CHANNELS,
  CHARACTER,
  extrapolation,
  indices,
  KEY_OPTIONS,
  key,
  NOW,
  placement,
  range,
  side,
} from '../schema/parts.ts';
import { boolean, index, list, nullable, number, oneOf, optional, record, text, whole } from '../schema/shape.ts';
import { type Taking, takes } from '../schema/takes.ts';
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

/** The shown take unless another is given. */
const TAKE = { ...CHARACTER, clip: optional(index) } as const;

const space = record({
  up: oneOf(['y', 'z']),
  unit: oneOf(LENGTH_UNITS),
  lift: number,
  metres: optional(number),
});

const COMMANDS: readonly Taking[] = [
  takes(setDofs, { ...NOW, dofs: list(record({ index, value: number })), key }),
  takes(resetPose, { ...NOW, to: oneOf(['file', 'zero']), key }),
  takes(setClamping, { ...CHARACTER, clamps: boolean }),
  takes(discardUnkeyed, { exceptSeconds: nullable(number) }),
  takes(keyPose, { ...NOW, dofs: optional(indices), ...KEY_OPTIONS }),
  takes(createClip, { ...CHARACTER, range, name: optional(text) }),
  takes(renameClip, { ...TAKE, name: text }),
  takes(duplicateClip, TAKE),
  takes(removeClip, TAKE),
  takes(setClipRange, { ...TAKE, range }),
  takes(setInterpolation, { ...TAKE, interpolation: oneOf(INTERPOLATIONS) }),
  takes(setSpace, { ...CHARACTER, space, ofSkeleton: optional(boolean) }),
  takes(setPositionChannels, { ...CHARACTER, positions: oneOf(['replace', 'add']) }),
  takes(setHidden, { ids: list(text), hidden: boolean }),
  takes(setLimit, { ...CHARACTER, dof: index, min: number, max: number }),
  takes(clearLimit, { ...CHARACTER, dof: index }),
  takes(setExtrapolation, { ...CHANNELS, side, extrapolation }),
  takes(removeCharacter, CHARACTER),
  takes(renameCharacter, { ...CHARACTER, name: text }),
  takes(showSkin, { ...CHARACTER, skin: index }),
  takes(showClip, { ...CHARACTER, clip: whole(-1) }),
  takes(setTimeOffset, { ...CHARACTER, seconds: number }),
  takes(placeCharacter, { ...CHARACTER, index, placement }),
  takes(addCopy, { ...CHARACTER, placement }),
  takes(removeCopy, { ...CHARACTER, index }),
];

export const COMMANDS_AT_HAND: ReadonlyMap<string, Taking> = new Map(COMMANDS.map((c) => [c.command.id, c]));

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
  'review.add',
  'review.remove',
  'review.set',
  'review.read',
  'takes.show',
  'takes.alignStarts',
  'takes.setTimeOffsets',
  'takes.arrange',
  'takes.endOverlay',
  'takes.overlay',
  'takes.remove',
  'takes.mirror',
  'takes.setSpeed',
  'takes.lockFeet',
  'takes.makeLoop',
  'takes.join',
  'takes.cutOut',
  'takes.insert',
  'markers.add',
  'markers.change',
  'markers.remove',
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
  'characters.sameUnit',
  'characters.ownHeights',
]);
