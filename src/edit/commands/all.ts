/** Every document command by id, with the arguments that it takes from scripts. */
import type { Document } from '../../model/document.ts';
import { MOTION_KINDS } from '../../model/joint-types.ts';
import { VERDICTS } from '../../model/review.ts';
import { AXIS_PAIRS, COMPOUND_DOFS, EULER_ORDERS, type Motion, SCALE_MODES } from '../../model/skeleton.ts';
import { COLLISIONS } from '../keys/arrange.ts';
import { PASTE_MODES } from '../keys/clipboard.ts';
import { AXIS_LETTERS, SKIN_MODES } from '../rig/rigging.ts';
import { JOIN_ALIGNMENTS } from '../samples/join.ts';
import {
  CHANNELS,
  CHARACTER,
  indices,
  KEYS,
  key,
  NOW,
  outsideCycle,
  range,
  side,
  takeRef,
  tangentKind,
  vector,
} from '../schema/parts.ts';
import {
  boolean,
  bytes,
  doubles,
  either,
  ifGiven,
  index,
  list,
  nullable,
  number,
  oneOf,
  optional,
  record,
  type Shape,
  text,
  whole,
} from '../schema/shape.ts';
import { notFromScripts, type Taking, takes } from '../schema/takes.ts';
import type { Command, Edit } from '../store.ts';
import { COMMANDS_AT_HAND } from './at-hand.ts';
import { bakeExtrapolation, eulerFilter, makeLoop, resample, simplify } from './channels.ts';
import { setCouple } from './couples.ts';
import { ownHeights, sameHeight, sameUnit } from './heights.ts';
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
import { autoWeights, BIND_PLACES } from './skin-weights.ts';
import { lockFeet, loopTakes, mirrorTakes, setTakeSpeed } from './take-edits.ts';
import { cutOutOfTakes, insertIntoTake, joinTakes } from './take-joins.ts';
import {
  ARRANGEMENTS,
  alignStarts,
  arrange,
  endOverlay,
  overlayTakes,
  removeTakes,
  setTimeOffsets,
  showTakes,
} from './takes.ts';
import { breakTangents, setSlopes, setTangents, unifyTangents } from './tangents.ts';

const PLACING = { outsideCycle: optional(outsideCycle), bakedRange: optional(range) } as const;
const onCollision = optional(oneOf(COLLISIONS));
const TAKES = { takes: list(takeRef) } as const;
const CHARACTERS = { characterIds: list(text) } as const;
const HOW_JOINED = { overlapSeconds: optional(number), align: optional(oneOf(JOIN_ALIGNMENTS)) } as const;

const tangents = record({ kinds: bytes, slopes: doubles });
const copied = record({
  seconds: number,
  channels: list(
    record({ channel: index, times: doubles, values: doubles, tangentsIn: tangents, tangentsOut: tangents }),
  ),
});

const FIRST = { ...CHARACTER, skin: optional(oneOf(SKIN_MODES)), timeSeconds: optional(number) } as const;
const JOINT = { ...FIRST, joint: index } as const;

const anyMotion = record({
  kind: oneOf(MOTION_KINDS),
  order: optional(oneOf([...EULER_ORDERS, ...AXIS_PAIRS])),
  axis: optional(vector),
  pitch: optional(number),
  mode: optional(oneOf(SCALE_MODES)),
  dofs: optional(list(oneOf(COMPOUND_DOFS))),
  channels: optional(list(oneOf(['tx', 'ty', 'tz', 'rx', 'ry', 'rz']))),
  positions: optional(oneOf(['replace', 'add'])),
});
/** Which parameters its kind needs is for the command to check. */
const motion: Shape<Motion> = { ...anyMotion, read: (value, path) => anyMotion.read(value, path) as Motion };

const namedValues = list(record({ name: text, value: number }));
const poseByNames = record({
  name: text,
  root: optional(vector),
  joints: list(record({ name: text, dofs: namedValues })),
  weights: namedValues,
});
const marker = record({ timeSeconds: number, endSeconds: optional(number), label: text });

const REVIEW = {
  verdict: optional(oneOf([...VERDICTS, ''])),
  stars: optional(index),
  tags: optional(list(text)),
  notes: optional(text),
} as const;

const PAIRS = { pairs: optional(list(record({ target: index, source: index }))) } as const;
const OPTIONS = {
  options: optional(
    record({
      scale: optional(number),
      reference: optional(either(oneOf(['automatic', 'rest']), number)),
      plantsFeet: optional(boolean),
    }),
  ),
} as const;

/** Commands that the page loads on their first use; it knows them by `FETCHED_IDS`. */
const FETCHED: readonly Taking[] = [
  takes(insertKeys, { ...CHANNELS, timeSeconds: number, ...PLACING }),
  takes(addKey, {
    ...NOW,
    channel: index,
    value: number,
    tangents: optional(tangentKind),
    ...PLACING,
  }),
  takes(moveKeys, { ...KEYS, seconds: number, values: optional(list(number)), onCollision }),
  takes(scaleKeys, {
    ...KEYS,
    pivotSeconds: number,
    timeFactor: number,
    valueFactor: number,
    pivotValues: optional(list(number)),
    onCollision,
  }),
  takes(setKeys, {
    ...KEYS,
    timeSeconds: ifGiven(number),
    value: optional(number),
    slopeIn: optional(number),
    slopeOut: optional(number),
  }),
  takes(snapKeys, { ...KEYS, framesPerSecond: number, offsetSeconds: optional(number) }),
  takes(removeKeys, { ...KEYS, timeSeconds: number }),
  takes(rippleKeys, { ...KEYS, seconds: number }),
  takes(pasteKeys, { ...NOW, copied, into: optional(indices), mode: oneOf(PASTE_MODES), ...PLACING }),
  takes(setTangents, { ...KEYS, side, kind: tangentKind }),
  takes(setSlopes, { ...KEYS, side, slope: number }),
  takes(unifyTangents, KEYS),
  takes(breakTangents, KEYS),
  takes(addToReview, { paths: list(text) }),
  takes(removeFromReview, { paths: list(text) }),
  takes(setReview, { paths: list(text), review: record(REVIEW) }),
  takes(readReview, {
    takes: list(record({ path: text, verdict: oneOf([...VERDICTS, '']), stars: index, tags: list(text), notes: text })),
  }),
  takes(showTakes, { ...TAKES, alone: optional(boolean) }),
  takes(alignStarts, { ...CHARACTERS, atSeconds: optional(number) }),
  takes(setTimeOffsets, { ...CHARACTERS, seconds: number }),
  takes(arrange, { ...CHARACTERS, how: oneOf(ARRANGEMENTS) }),
  takes(overlayTakes, { first: takeRef, second: takeRef }),
  notFromScripts(endOverlay, 'it takes whole characters. Run "compare.stop"'),
  takes(removeTakes, TAKES),
  takes(mirrorTakes, TAKES),
  takes(setTakeSpeed, { ...TAKES, factor: number }),
  takes(lockFeet, { ...TAKES, easeSeconds: optional(number), toleranceMetres: optional(number) }),
  takes(loopTakes, { ...TAKES, blendSeconds: optional(number) }),
  takes(joinTakes, { ...TAKES, ...HOW_JOINED, name: optional(text) }),
  takes(cutOutOfTakes, { ...TAKES, ...HOW_JOINED, from: number, to: number, areOfTransport: optional(boolean) }),
  takes(insertIntoTake, {
    into: takeRef,
    atSeconds: number,
    take: optional(takeRef),
    holdSeconds: optional(number),
    ...HOW_JOINED,
  }),
  takes(addMarkers, { ...CHARACTER, clip: optional(index), markers: list(marker) }),
  takes(changeMarker, { ...CHARACTER, clip: optional(index), index, marker }),
  takes(removeMarkers, { ...CHARACTER, clip: optional(index), indices }),
  takes(simplify, {
    ...CHANNELS,
    tolerance: either(
      number,
      record({
        angle: optional(number),
        length: optional(number),
        factor: optional(number),
        weight: optional(number),
      }),
    ),
    range: optional(range),
  }),
  takes(resample, {
    ...CHANNELS,
    framesPerSecond: number,
    offsetSeconds: optional(number),
    from: number,
    to: number,
    tangents: oneOf(['linear', 'smooth']),
  }),
  takes(eulerFilter, CHANNELS),
  takes(bakeExtrapolation, { ...CHANNELS, from: number, to: number }),
  takes(makeLoop, { ...CHANNELS, keepOffset: optional(either(boolean, indices)) }),
  takes(cropSamples, { ...CHARACTER, from: number, to: number }),
  takes(trimSamples, { ...NOW, side: oneOf(['start', 'end']) }),
  takes(splitSamples, NOW),
  takes(resampleSamples, { ...CHARACTER, framesPerSecond: number }),
  takes(reverseSamples, CHARACTER),
  takes(smoothSamples, {
    ...CHARACTER,
    channels: optional(indices),
    filter: optional(oneOf(['gaussian', 'median'])),
    sigmaSeconds: optional(number),
    frames: optional(index),
    range: optional(range),
  }),
  takes(convertToKeys, {
    ...CHARACTER,
    channels: optional(indices),
    tolerance: record({ position: number, angle: number }),
  }),
  takes(setRetarget, { ...CHARACTER, sourceId: text, ...PAIRS, ...OPTIONS }),
  takes(changeRetarget, { ...CHARACTER, ...PAIRS, ...OPTIONS }),
  takes(clearRetarget, CHARACTER),
  takes(bakeRetarget, { ...CHARACTER, framesPerSecond: optional(number), name: optional(text) }),
  takes(mirrorPose, { ...NOW, joint: optional(index), way: oneOf(['swap', 'toOther']), key }),
  takes(pastePose, { ...NOW, pose: poseByNames, key }),
  takes(keepPose, { ...NOW, name: optional(text) }),
  takes(updatePose, { ...NOW, pose: index }),
  takes(renamePose, { ...CHARACTER, pose: index, name: text }),
  takes(removePoses, { ...CHARACTER, poses: indices }),
  takes(applyPose, { ...NOW, pose: index, share: optional(number), joints: optional(indices), key }),
  takes(addToLibrary, { ...CHARACTER, poses: list(poseByNames) }),
  takes(pinPoint, {
    ...CHARACTER,
    joint: index,
    point: vector,
    weight: optional(number),
    holdsOrientation: optional(boolean),
  }),
  takes(unpin, { ...CHARACTER, pins: indices }),
  takes(clearPins, CHARACTER),
  takes(setPin, {
    ...CHARACTER,
    pin: index,
    weight: optional(number),
    holdsOrientation: optional(boolean),
    joint: optional(index),
    point: optional(vector),
  }),
  takes(setStiffness, { ...CHARACTER, joints: indices, stiffness: either(number, oneOf(['locked', 'usual'])) }),
  takes(setRootFree, { ...CHARACTER, isFree: boolean }),
  takes(holdPins, {
    ...CHARACTER,
    pins: indices,
    range,
    atSeconds: number,
    framesPerSecond: number,
    easeSeconds: optional(number),
    tolerance: optional(number),
  }),
  takes(createRig, { name: optional(text), characterId: optional(text), skin: optional(oneOf(SKIN_MODES)) }),
  takes(addJoint, { ...FIRST, parent: index, name: optional(text), offset: optional(vector) }),
  takes(renameJoint, { ...JOINT, name: text }),
  takes(reparentJoint, { ...JOINT, parent: index, before: optional(index) }),
  takes(removeJoint, { ...JOINT, children: oneOf(['too', 'stay']) }),
  takes(mirrorJoint, { ...JOINT, across: oneOf(AXIS_LETTERS) }),
  takes(setOffset, { ...JOINT, offset: vector, children: oneOf(['follow', 'stay']) }),
  takes(setMotion, { ...JOINT, motion }),
  takes(setBox, { ...JOINT, box: record({ min: vector, max: vector }) }),
  takes(setLength, { ...JOINT, length: nullable(number) }),
  takes(setFilePose, { ...FIRST, joint: optional(index), from: oneOf(['shown', 'rest']) }),
  takes(setCouple, {
    ...JOINT,
    dof: text,
    follows: nullable(record({ joint: index, dof: text, gain: number, offset: number })),
  }),
  takes(limitRigged, { ...FIRST, dof: index, min: number, max: number }),
  takes(clearLimitRigged, { ...FIRST, dof: index }),
  takes(autoWeights, {
    ...NOW,
    skin: optional(index),
    bind: optional(oneOf(BIND_PLACES)),
    mostInfluences: optional(whole(1)),
  }),
  takes(sameHeight, { ...CHARACTERS, like: text }),
  takes(sameUnit, { ...CHARACTERS, like: text }),
  takes(ownHeights, CHARACTERS),
];

/** All commands with what they take. */
export const ALL_COMMANDS: ReadonlyMap<string, Taking> = new Map([
  ...COMMANDS_AT_HAND,
  ...FETCHED.map((c) => [c.command.id, c] as const),
]);

/** For tests, and others that give arguments of the right type. */
export const COMMANDS_BY_ID: ReadonlyMap<string, Command<never, Document | Edit>> = new Map(
  [...ALL_COMMANDS].map(([id, { command }]) => [id, command]),
);

/** The arguments of each command in words, for `marrow.commands()`. */
export function commandList(): readonly CommandInfo[] {
  return [...ALL_COMMANDS].map(([id, { fields }]) => ({
    id,
    arguments: Object.fromEntries(
      Object.entries(fields).map(([name, { what, isOptional }]) => [
        name,
        isOptional ? `${what}; may be left out` : what,
      ]),
    ),
  }));
}

export interface CommandInfo {
  readonly id: string;
  /** By name, what each must be. */
  readonly arguments: Readonly<Record<string, string>>;
}
