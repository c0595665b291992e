/** Every document command by id, for the console, scripts and tests. */
import type { Document } from '../../model/document.ts';
import type { Command, Edit } from '../store.ts';
import { COMMANDS_AT_HAND } from './at-hand.ts';
import { bakeExtrapolation, eulerFilter, makeLoop, resample, simplify } from './channels.ts';
import { setCouple } from './couples.ts';
import { ownHeights, sameHeight } from './heights.ts';
import { holdPins } from './hold.ts';
import { clearPins, pinPoint, setPin, setRootFree, setStiffness, unpin } from './ik.ts';
import { addKey, insertKeys, moveKeys, removeKeys, rippleKeys, scaleKeys, setKeys, snapKeys } from './keys.ts';
import { addMarkers, changeMarker, removeMarkers } from './markers.ts';
import { pasteKeys } from './paste.ts';
import {
  addToLibrary,
  applyPose,
  keepPose,
  mirrorPose,
  pastePose,
  removePoses,
  renamePose,
  updatePose,
} from './poses.ts';
import { bakeRetarget, changeRetarget, clearRetarget, setRetarget } from './retarget.ts';
import { addToReview, readReview, removeFromReview, setReview } from './review.ts';
import { addJoint, createRig, mirrorJoint, removeJoint, reparentJoint } from './rig.ts';
import { renameJoint, setBox, setFilePose, setLength, setMotion, setOffset } from './rig-joint.ts';
import { clearLimitRigged, limitRigged } from './rig-limits.ts';
import {
  convertToKeys,
  cropSamples,
  resampleSamples,
  reverseSamples,
  smoothSamples,
  splitSamples,
  trimSamples,
} from './samples.ts';
import { autoWeights } from './skin-weights.ts';
import { lockFeet, loopTakes, mirrorTakes, setTakeSpeed } from './take-edits.ts';
import { cutOutOfTakes, insertIntoTake, joinTakes } from './take-joins.ts';
import { alignStarts, arrange, endOverlay, overlayTakes, removeTakes, setTimeOffsets, showTakes } from './takes.ts';
import { breakTangents, setSlopes, setTangents, unifyTangents } from './tangents.ts';

/** Commands that the page loads on their first use; it knows them by `FETCHED_IDS`. */
const FETCHED: readonly Command<never, Document | Edit>[] = [
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
  addToReview,
  removeFromReview,
  setReview,
  readReview,
  showTakes,
  alignStarts,
  setTimeOffsets,
  arrange,
  endOverlay,
  overlayTakes,
  removeTakes,
  mirrorTakes,
  setTakeSpeed,
  lockFeet,
  loopTakes,
  joinTakes,
  cutOutOfTakes,
  insertIntoTake,
  addMarkers,
  changeMarker,
  removeMarkers,
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
  setRetarget,
  changeRetarget,
  clearRetarget,
  bakeRetarget,
  mirrorPose,
  pastePose,
  keepPose,
  updatePose,
  renamePose,
  removePoses,
  applyPose,
  addToLibrary,
  pinPoint,
  unpin,
  clearPins,
  setPin,
  setStiffness,
  setRootFree,
  holdPins,
  createRig,
  addJoint,
  renameJoint,
  reparentJoint,
  removeJoint,
  mirrorJoint,
  setOffset,
  setMotion,
  setBox,
  setLength,
  setFilePose,
  setCouple,
  limitRigged,
  clearLimitRigged,
  autoWeights,
  sameHeight,
  ownHeights,
];

export const COMMANDS_BY_ID: ReadonlyMap<string, Command<never, Document | Edit>> = new Map([
  ...COMMANDS_AT_HAND,
  ...FETCHED.map((c) => [c.id, c] as const),
]);
