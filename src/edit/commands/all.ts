/** Every command on the document by its id, for whoever asks by name: the console, scripts, tests. */
import type { Document } from '../../model/document.ts';
import type { Command, Edit } from '../store.ts';
import { bakeExtrapolation, eulerFilter, makeLoop, resample, simplify } from './channels.ts';
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
import { addKey, insertKeys, moveKeys, removeKeys, rippleKeys, scaleKeys, setKeys, snapKeys } from './keys.ts';
import { clearLimit, setLimit } from './limits.ts';
import { pasteKeys } from './paste.ts';
import { dropUnkeyed, resetPose, setClamping, setDofs } from './pose.ts';
import { bakeRetarget, changeRetarget, clearRetarget, setRetarget } from './retarget.ts';
import {
  convertToKeys,
  cropSamples,
  resampleSamples,
  reverseSamples,
  smoothSamples,
  splitSamples,
  trimSamples,
} from './samples.ts';
import { setHidden, setPositionChannels, setSpace } from './spaces.ts';
import { alignStarts, arrange, overlayTakes, removeTakes, setTimeOffsets, showTakes } from './takes.ts';
import { breakTangents, setSlopes, setTangents, unifyTangents } from './tangents.ts';

/** Arguments come from outside here: each command checks its own and refuses with a `CommandError`. */
const COMMANDS: readonly Command<never, Document | Edit>[] = [
  setDofs,
  resetPose,
  setClamping,
  dropUnkeyed,
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
  insertKeys,
  addKey,
  moveKeys,
  scaleKeys,
  setKeys,
  snapKeys,
  removeKeys,
  rippleKeys,
  pasteKeys,
  setTangents,
  setSlopes,
  unifyTangents,
  breakTangents,
  setExtrapolation,
  simplify,
  resample,
  eulerFilter,
  bakeExtrapolation,
  makeLoop,
  cropSamples,
  trimSamples,
  splitSamples,
  resampleSamples,
  reverseSamples,
  smoothSamples,
  convertToKeys,
  removeCharacter,
  renameCharacter,
  showSkin,
  showClip,
  setTimeOffset,
  placeCharacter,
  addCopy,
  removeCopy,
  showTakes,
  alignStarts,
  setTimeOffsets,
  arrange,
  overlayTakes,
  removeTakes,
  setRetarget,
  changeRetarget,
  clearRetarget,
  bakeRetarget,
];

export const COMMANDS_BY_ID: ReadonlyMap<string, Command<never, Document | Edit>> = new Map(
  COMMANDS.map((c) => [c.id, c]),
);
