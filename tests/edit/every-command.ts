/**
 * For every command a document and arguments with which it changes that, and others with which there is nothing to do:
 * it says so by a `CommandError`, or gives the very same document.
 */

import { addAttachment } from '../../src/edit/commands/beside/attach.ts';
import type { FollowedDof } from '../../src/edit/commands/couples.ts';
import { copyKeys } from '../../src/edit/keys/clipboard.ts';
import { poseByNames } from '../../src/edit/pose/by-names.ts';
import { type Character, DEFAULT_PLACEMENT, type Document } from '../../src/model/document.ts';
import { DEFAULT_BOX, UNLIMITED } from '../../src/model/skeleton/skeleton.ts';
import { oneSurface } from '../../src/model/skin.ts';
import { DEFAULT_SPACE } from '../../src/model/space.ts';
import { NO_REVIEW } from '../../src/model/takes/review.ts';
import { restChannel, type Take } from '../../src/model/takes/take.ts';
import { tube } from '../evaluate/weights/meshes.ts';
import { character, documentOf, joint, morph, skin, takeOfValues } from '../helpers/builders.ts';
import { sliding } from './hold/sliding.ts';
import { channelOf } from './keys/channels.ts';
import { layeredTake, layerOf } from './layers/layered.ts';
import { swinging, takeOfColumns } from './samples/made.ts';

export interface EditCase {
  readonly document: Document;
  readonly args: object;
  /** In the same document. */
  readonly idle: object;
}

const SIDES = [
  joint(-1, { name: 'body' }),
  joint(0, { name: 'arm_l', offset: [1, 0, 0], limits: [{ min: -1, max: 1 }, UNLIMITED, UNLIMITED] }),
  joint(0, { name: 'arm_r', offset: [-1, 0, 0], length: 2 }),
  joint(2, { name: 'hand_r', offset: [0, 2, 0] }),
];
/** Root translation, 4 joints, a morph. */
const DOFS = 16;
const WAVE = channelOf([
  [0, 0],
  [0.5, 0.25, 0.5, 1],
  [1, 0.5],
  [2, -0.3],
]);
/** On a straight line. */
const LINE = channelOf(
  [
    [0, 0],
    [1, 1],
    [2, 2],
  ],
  'linear',
);

const WALK: Take = {
  name: 'hero_walk',
  range: [0, 2],
  channels: Array.from({ length: DOFS }, (_, c) => (c === 3 ? WAVE : c === 6 ? LINE : restChannel())),
};

const HERO: Character = character({
  skeleton: { name: 'hero', joints: SIDES },
  morphs: [morph('smile')],
  skins: [skin('hero'), skin('armour')],
  takes: [WALK, { ...WALK, name: 'hero_run' }],
  shownTake: 0,
  pose: Array<number>(DOFS).fill(0),
  poses: [{ name: 'wave', values: Array<number>(DOFS).fill(0.25) }],
  ik: {
    pins: [{ id: 1, joint: 3, point: [0, 0, 0], weight: 1, holdsOrientation: false }],
    stiff: [],
    rootIsFree: true,
  },
});
const ALONE = documentOf(HERO);
/** Shows no take. */
const POSED = documentOf({ ...HERO, shownTake: -1 });
const UNKEYED = documentOf({ ...HERO, unkeyed: { timeSeconds: 1, dofs: [3], values: [0.7] } });
/** With a set and a lock. */
const SETS = documentOf({
  ...HERO,
  sets: { sets: [{ name: 'arms', joints: [1, 2] }], locked: [{ joint: 1, dofs: ['rx'] }] },
});
const CAPTURED = documentOf(swinging());

/** With a marker and a span. */
const MARKED = documentOf(
  swinging({
    ...takeOfColumns((c, t) => c * t),
    markers: [
      { timeSeconds: 0.5, label: 'step' },
      { timeSeconds: 1, endSeconds: 1.5, label: 'stand' },
    ],
  }),
);

const bee = (id: string, more: Partial<Character> = {}): Character =>
  character({
    id,
    name: id,
    takes: [takeOfValues(`${id}_walk`, Array<number>(9).fill(0.3), [1, 2])],
    shownTake: 0,
    ...more,
  });
const TWO = documentOf(HERO, bee('c2'));
const BEES = documentOf(bee('c1'), bee('c2', { placements: [{ ...DEFAULT_PLACEMENT, position: [3, 0, 0] }] }));

const WAVING = WALK.channels.map((_, c) => (c === 6 ? WAVE : restChannel()));
const NODDING = WALK.channels.map((_, c) => (c === 9 || c === 6 ? LINE : restChannel()));
const LAYERED = documentOf(
  {
    ...HERO,
    takes: [
      layeredTake(WALK.channels, [
        layerOf(WAVING, { name: 'arm' }),
        layerOf(NODDING, { name: 'more', joints: ['arm_r'] }),
      ]),
    ],
  },
  bee('c2'),
);
const layered = (args: object, idle: object): EditCase => ({ document: LAYERED, args, idle });

/** An arm that goes to a point. */
const LIMBED = documentOf({
  ...HERO,
  limbs: { list: [{ name: 'arm', joints: [2, 3], tip: [0, 0, 0], orient: false }] },
  takes: [
    {
      ...WALK,
      goals: { list: [{ limb: 'arm', space: 'world', channels: { tx: { curve: -1 }, ty: { curve: WAVE } } }] },
    },
  ],
});
const limbed = (args: object, idle: object): EditCase => ({ document: LIMBED, args, idle });

function driven({ skeleton, takes: [own], name, pose, clampsToLimits, timeOffsetSeconds }: Character): Document {
  if (!skeleton) throw new Error('no skeleton');
  const source = { name, skeleton, take: own, pose, clampsToLimits, timeOffsetSeconds };
  const pairs = [{ target: 0, source: 0 }];
  const driver = { sourceId: 'c2', source, pairs, options: { reference: 'rest', plantsFeet: false } } as const;
  return documentOf({ ...HERO, driver }, bee('c2'));
}
const DRIVEN = driven(bee('c2'));

const ATTACHED = addAttachment.run(documentOf(HERO, bee('c2')), {
  ...{ characterId: 'c1', leaderId: 'c2', joint: 0 },
  span: [0.5, 1],
});

const UNEQUAL = documentOf(HERO, bee('c2', { placements: [{ ...DEFAULT_PLACEMENT, scale: 5 }] }));

const OVERLAID: readonly Character[] = [BEES.characters[0], { ...BEES.characters[1], placements: [DEFAULT_PLACEMENT] }];

const TUBE = tube({ around: 4, along: 4, radius: 0.5, length: 4 });
const SLEEVE: Document = documentOf(
  character({
    skeleton: {
      name: 'arm',
      joints: [joint(-1, { offset: [0, 0, 0], length: 2 }), joint(0, { offset: [0, 2, 0], length: 2 })],
    },
    skins: [{ name: 'sleeve', ...TUBE, surfaces: oneSurface(TUBE.triangles), bindings: new Float64Array(0) }],
  }),
);

const WHO = { characterId: 'c1' };
const NOW = { ...WHO, timeSeconds: 0.75 };
const KEY = [{ channel: 3, indices: [1] }];
const KEYS = { ...WHO, keys: KEY };
const BOTH = { characterIds: ['c1', 'c2'] };
const FOLLOWS: FollowedDof = { joint: 0, dof: 'ry', gain: 0.5, offset: 0 };

function alone(args: object, idle: object): EditCase {
  return { document: ALONE, args, idle };
}

/** With two takes in review. */
function reviewed(args: object, idle: object): EditCase {
  const review = ['a.bvh', 'b.bvh'].map((path) => ({ path, ...NO_REVIEW }));
  return { document: { ...ALONE, review }, args, idle };
}

function captured(args: object, idle: object): EditCase {
  return { document: CAPTURED, args: { ...WHO, ...args }, idle: { ...WHO, ...idle } };
}

/** By the command's id. */
export const CASES: Readonly<Record<string, EditCase>> = {
  'pose.setDofs': alone({ ...NOW, dofs: [{ index: 4, value: 0.5 }] }, { ...NOW, dofs: [{ index: 4, value: 0 }] }),
  'pose.reset': {
    document: documentOf({ ...HERO, shownTake: -1, pose: HERO.pose.with(5, 1) }),
    args: { ...NOW, to: 'zero' },
    idle: { ...NOW, to: 'somewhere' },
  },
  'pose.tween': alone({ ...NOW, u: 0.5 }, { ...NOW, u: 0.5, dofs: [] }),
  'pose.relax': alone({ ...NOW, amount: 0.5 }, { ...NOW, amount: 0 }),
  'pose.setClamping': alone({ ...WHO, clamps: false }, { ...WHO, clamps: true }),
  'pose.dropUnkeyed': { document: UNKEYED, args: { exceptSeconds: null }, idle: { exceptSeconds: 1 } },
  'pose.key': alone({ ...NOW, dofs: [3, 4], tangents: 'linear' }, { ...NOW, dofs: [] }),
  'keys.forMoment': alone(
    { ...NOW, dofs: [{ index: 3, value: 0.9 }], easeIn: 0.2, easeOut: 0.3 },
    { ...NOW, dofs: [], easeIn: 0.2, easeOut: 0.3 },
  ),
  'take.create': alone({ ...WHO, range: [0, 3] }, { ...WHO, range: [3, 0] }),
  'take.rename': alone({ ...WHO, name: 'stroll' }, { ...WHO, name: 'hero_walk' }),
  'take.duplicate': alone(WHO, { ...WHO, take: 2 }),
  'take.remove': alone(WHO, { ...WHO, take: 2 }),
  'take.setRange': alone({ ...WHO, range: [-1, 1] }, { ...WHO, range: [0, 2] }),
  'take.setInterpolation': captured({ interpolation: 'cubic' }, { interpolation: 'linear' }),
  'character.setSpace': {
    document: documentOf({ ...HERO, space: DEFAULT_SPACE }),
    args: { ...WHO, space: { up: 'z', unit: 'inches', lift: 1 } },
    idle: { ...WHO, space: { ...DEFAULT_SPACE } },
  },
  'skeleton.setPositionChannels': captured({ positions: 'add' }, { positions: 'replace' }),
  'character.setHidden': {
    document: TWO,
    args: { ids: ['c1', 'c2'], hidden: true },
    idle: { ids: ['c1'], hidden: false },
  },
  'skeleton.setLimit': alone({ ...WHO, dof: 4, min: -1, max: 2 }, { ...WHO, dof: 6, min: -1, max: 1 }),
  'skeleton.clearLimit': alone({ ...WHO, dof: 6 }, { ...WHO, dof: 4 }),
  'keys.insert': alone({ ...NOW, channels: [3, 4] }, { ...WHO, timeSeconds: 1, channels: [3] }),
  'keys.add': alone({ ...NOW, channel: 3, value: 2 }, { ...WHO, timeSeconds: 1, channel: 3, value: 0.5 }),
  'keys.move': alone({ ...KEYS, seconds: 0.25, values: [1] }, { ...KEYS, seconds: 0 }),
  'keys.scale': alone(
    { ...KEYS, pivotSeconds: 0, timeFactor: 1.5, valueFactor: 2 },
    { ...KEYS, pivotSeconds: 0, timeFactor: 1, valueFactor: 1 },
  ),
  'keys.tween': alone({ ...KEYS, u: 0.75 }, { ...WHO, keys: [], u: 0.5 }),
  'keys.relax': alone({ ...WHO, keys: [{ channel: 3, indices: [2] }], amount: 0.5 }, { ...KEYS, amount: 0 }),
  'keys.ease': alone({ ...KEYS, amount: 0.5 }, { ...WHO, keys: [], amount: 0.5 }),
  'keys.set': alone({ ...KEYS, value: 3 }, { ...KEYS, value: 0.25 }),
  'keys.snap': alone({ ...KEYS, framesPerSecond: 3 }, { ...KEYS, framesPerSecond: 2 }),
  'keys.remove': alone({ ...KEYS, timeSeconds: 0 }, { ...WHO, keys: [], timeSeconds: 0 }),
  'keys.ripple': alone({ ...KEYS, seconds: 1 }, { ...KEYS, seconds: 0 }),
  'keys.paste': alone(
    { ...NOW, copied: copyKeys(WALK, KEY), mode: 'insert' },
    { ...WHO, timeSeconds: 0.5, copied: copyKeys(WALK, KEY), mode: 'merge' },
  ),
  'keys.setTangents': alone({ ...KEYS, side: 'both', kind: 'smooth' }, { ...KEYS, side: 'in', kind: 'fixed' }),
  'keys.setSlopes': alone({ ...KEYS, side: 'in', slope: 3 }, { ...KEYS, side: 'out', slope: 1 }),
  'keys.unify': alone(KEYS, { ...WHO, keys: [{ channel: 6, indices: [1] }] }),
  'keys.break': alone({ ...WHO, keys: [{ channel: 6, indices: [1] }] }, KEYS),
  'channels.setExtrapolation': alone(
    { ...WHO, channels: [3], side: 'both', extrapolation: 'cycle' },
    { ...WHO, channels: [6], side: 'in', extrapolation: 'linear' },
  ),
  'character.remove': { document: TWO, args: WHO, idle: { characterId: 'c9' } },
  'character.rename': alone({ ...WHO, name: 'heroine' }, { ...WHO, name: 'hero' }),
  'character.showSkin': alone({ ...WHO, skin: 1 }, { ...WHO, skin: 0 }),
  'character.showTake': alone({ ...WHO, take: -1 }, { ...WHO, take: 0 }),
  'character.setTimeOffset': alone({ ...WHO, seconds: 1 }, { ...WHO, seconds: 0 }),
  'character.place': alone(
    { ...WHO, index: 0, placement: { ...DEFAULT_PLACEMENT, scale: 2 } },
    { ...WHO, index: 0, placement: { ...DEFAULT_PLACEMENT } },
  ),
  'character.addCopy': alone({ ...WHO, placement: { ...DEFAULT_PLACEMENT, position: [2, 0, 0] } }, WHO),
  'character.removeCopy': {
    document: documentOf({ ...HERO, placements: [DEFAULT_PLACEMENT, DEFAULT_PLACEMENT] }),
    args: { ...WHO, index: 1 },
    idle: { ...WHO, index: 2 },
  },
  'characters.sameHeight': {
    document: UNEQUAL,
    args: { ...BOTH, like: 'c1' },
    idle: { characterIds: [], like: 'c1' },
  },
  'characters.sameUnit': {
    document: UNEQUAL,
    args: { ...BOTH, like: 'c1' },
    idle: { characterIds: [], like: 'c1' },
  },
  'characters.ownHeights': { document: UNEQUAL, args: BOTH, idle: { characterIds: [] } },
  'takes.show': {
    document: TWO,
    args: { takes: [{ ...WHO, take: 1 }], alone: true },
    idle: { takes: [{ ...WHO, take: 0 }] },
  },
  'takes.alignStarts': { document: TWO, args: BOTH, idle: { characterIds: ['c1'] } },
  'takes.setTimeOffsets': { document: TWO, args: { ...BOTH, seconds: 1 }, idle: { ...BOTH, seconds: 0 } },
  'takes.arrange': { document: BEES, args: { ...BOTH, how: 'spot' }, idle: { characterIds: ['c1'], how: 'space' } },
  'takes.overlay': {
    document: BEES,
    args: { first: { characterId: 'c1', take: 0 }, second: { characterId: 'c2', take: 0 } },
    idle: { first: { characterId: 'c1', take: 0 } },
  },
  'takes.endOverlay': {
    document: documentOf(...OVERLAID),
    args: { before: BEES.characters, overlaid: OVERLAID },
    idle: { before: OVERLAID, overlaid: OVERLAID },
  },
  'review.add': reviewed({ paths: ['a.bvh', 'new.bvh'] }, { paths: ['a.bvh'] }),
  'review.remove': reviewed({ paths: ['a.bvh', 'b.bvh'] }, { paths: ['gone.bvh'] }),
  'review.set': reviewed(
    { paths: ['a.bvh', 'b.bvh'], review: { verdict: 'bad', stars: 2 } },
    { paths: ['a.bvh'], review: { verdict: '' } },
  ),
  'review.read': reviewed(
    { takes: ['a.bvh', 'b.bvh'].map((path) => ({ path, ...NO_REVIEW, tags: ['runs'], notes: path })) },
    { takes: [{ path: 'gone.bvh', ...NO_REVIEW, verdict: 'good' }] },
  ),
  'takes.remove': alone({ takes: [{ ...WHO, take: 0 }] }, { takes: [] }),
  'markers.add': {
    document: MARKED,
    args: { ...WHO, markers: [{ timeSeconds: 1, label: 'turn' }] },
    idle: { ...WHO, markers: [{ timeSeconds: 0.5, label: 'step' }] },
  },
  'markers.change': {
    document: MARKED,
    args: { ...WHO, index: 1, marker: { timeSeconds: 0, label: 'begins' } },
    idle: { ...WHO, index: 0, marker: { timeSeconds: 0.5, label: 'step' } },
  },
  'markers.remove': { document: MARKED, args: { ...WHO, indices: [0] }, idle: { ...WHO, indices: [] } },
  'takes.lockFeet': {
    document: documentOf(sliding(0.004)),
    args: { takes: [{ ...WHO, take: 0 }] },
    idle: { takes: [{ ...WHO, take: 0 }], toleranceMetres: 1 },
  },
  'takes.makeLoop': captured(
    { takes: [{ ...WHO, take: 0 }], blendSeconds: 0.25 },
    { takes: [{ ...WHO, take: 0 }], blendSeconds: -1 },
  ),
  'takes.setSpeed': captured({ takes: [{ ...WHO, take: 0 }], factor: 2 }, { takes: [{ ...WHO, take: 0 }], factor: 1 }),
  'takes.join': alone(
    { takes: [0, 1].map((take) => ({ ...WHO, take })), overlapSeconds: 0.1 },
    { takes: [{ ...WHO, take: 0 }] },
  ),
  'takes.cutOut': captured(
    { takes: [{ ...WHO, take: 0 }], from: 0.5, to: 1 },
    { takes: [{ ...WHO, take: 0 }], from: 5, to: 6 },
  ),
  'takes.insert': captured(
    { into: { ...WHO, take: 0 }, atSeconds: 1, holdSeconds: 0.5 },
    { into: { ...WHO, take: 0 }, atSeconds: 1, holdSeconds: 0 },
  ),
  'takes.mirror': alone({ takes: [{ ...WHO, take: 0 }] }, { takes: [] }),
  'channels.simplify': alone({ ...WHO, channels: [6], tolerance: 0.01 }, { ...WHO, channels: [3], tolerance: 1e-9 }),
  'channels.resample': alone(
    { ...WHO, channels: [3], framesPerSecond: 4, from: 0, to: 2, tangents: 'smooth' },
    { ...WHO, channels: [4], framesPerSecond: 4, from: 0, to: 2, tangents: 'smooth' },
  ),
  'channels.eulerFilter': {
    document: documentOf({
      ...HERO,
      takes: [
        {
          ...WALK,
          channels: WALK.channels.with(
            3,
            channelOf([
              [0, 0],
              [1, 2 * Math.PI + 0.1],
            ]),
          ),
        },
      ],
    }),
    args: { ...WHO, channels: [3, 4, 5] },
    idle: { ...WHO, channels: [] },
  },
  'channels.bakeExtrapolation': {
    document: documentOf({ ...HERO, takes: [{ ...WALK, channels: [{ ...WAVE, extrapolateOut: 'cycle' }, LINE] }] }),
    args: { ...WHO, channels: [0], from: 0, to: 5 },
    idle: { ...WHO, channels: [0], from: 0, to: 1 },
  },
  'channels.makeLoop': alone({ ...WHO, channels: [3] }, { ...WHO, channels: [4] }),
  'samples.crop': captured({ from: 0.5, to: 1 }, { from: 0, to: 2 }),
  'samples.trim': captured({ side: 'end', timeSeconds: 1 }, { side: 'end', timeSeconds: 2 }),
  'samples.split': captured({ timeSeconds: 1 }, { timeSeconds: 0 }),
  'samples.resample': captured({ framesPerSecond: 30 }, { framesPerSecond: 60 }),
  'samples.reverse': {
    document: documentOf(...CAPTURED.characters, { ...swinging(takeOfColumns(() => 0, 2)), id: 'c2' }),
    args: WHO,
    idle: { characterId: 'c2' },
  },
  'samples.smooth': captured({ sigmaSeconds: 0.1 }, { sigmaSeconds: 0.1, range: [5, 6] }),
  'samples.convertToKeys': captured({ tolerance: { position: 0.01, angle: 0.01 } }, { tolerance: 1 }),
  'retarget.set': {
    document: DRIVEN,
    args: { ...WHO, sourceId: 'c2' },
    idle: {
      ...WHO,
      sourceId: 'c2',
      pairs: [{ target: 0, source: 0 }],
      options: { reference: 'rest', plantsFeet: false },
    },
  },
  'retarget.change': {
    document: DRIVEN,
    args: { ...WHO, options: { scale: 2 } },
    idle: { ...WHO, options: { reference: 'rest' } },
  },
  'retarget.clear': { document: DRIVEN, args: WHO, idle: { characterId: 'c2' } },
  'retarget.bake': { document: DRIVEN, args: WHO, idle: { characterId: 'c2' } },
  'poses.mirror': {
    document: documentOf({ ...HERO, shownTake: -1, pose: HERO.pose.with(6, 0.5) }),
    args: { ...NOW, way: 'swap' },
    idle: { ...NOW, way: 'toOther', joint: 0 },
  },
  'poses.paste': {
    document: POSED,
    args: { ...NOW, pose: poseByNames(HERO, { name: 'wave', values: HERO.pose.with(4, 1) }) },
    idle: { ...NOW, pose: poseByNames(HERO, { name: 'same', values: HERO.pose }) },
  },
  'poses.keep': alone({ ...NOW, name: 'stand' }, { ...NOW, name: '' }),
  'poses.update': alone({ ...NOW, pose: 0 }, { ...NOW, pose: 1 }),
  'poses.rename': alone({ ...WHO, pose: 0, name: 'greet' }, { ...WHO, pose: 0, name: 'wave' }),
  'poses.remove': alone({ ...WHO, poses: [0] }, { ...WHO, poses: [] }),
  'poses.apply': { document: POSED, args: { ...NOW, pose: 0, share: 0.5 }, idle: { ...NOW, pose: 0, share: 0 } },
  'poses.add': alone(
    { ...WHO, poses: [poseByNames(HERO, { name: 'bow', values: HERO.pose.with(3, 1) })] },
    { ...WHO, poses: [] },
  ),
  'ik.pin': alone({ ...WHO, joint: 1, point: [0, 1, 0] }, { ...WHO, joint: 3, point: [0, 0, 0] }),
  'ik.unpin': alone({ ...WHO, pins: [1] }, { ...WHO, pins: [] }),
  'ik.clearPins': { document: TWO, args: WHO, idle: { characterId: 'c2' } },
  'ik.setPin': alone({ ...WHO, pin: 1, weight: 2 }, { ...WHO, pin: 1, weight: 1 }),
  'ik.setStiffness': alone({ ...WHO, joints: [2, 1], stiffness: 4 }, { ...WHO, joints: [1], stiffness: 'usual' }),
  'sets.add': alone({ ...WHO, name: 'arms', color: '#ff0000', joints: [2, 1] }, { ...WHO, name: 'none', joints: [] }),
  'sets.change': { document: SETS, args: { ...WHO, set: 0, joints: [3] }, idle: { ...WHO, set: 0, name: 'arms' } },
  'sets.remove': { document: SETS, args: { ...WHO, set: 0 }, idle: { ...WHO, set: 1 } },
  'dofs.setLocked': {
    document: SETS,
    args: { ...WHO, dofs: [0, 4, 6], locked: true },
    idle: { ...WHO, dofs: [6], locked: true },
  },
  'ik.move': {
    document: POSED,
    args: { ...NOW, joint: 3, to: [-1, 1, 2] },
    idle: { ...NOW, joint: 9, to: [0, 0, 0] },
  },
  'path.moveKey': {
    document: documentOf({ ...HERO, takes: [{ ...WALK, channels: WALK.channels.map(() => WAVE) }] }),
    args: { ...NOW, timeSeconds: 1, joint: 3, to: [-1, 1, 2] },
    idle: { ...NOW, timeSeconds: 1.3, joint: 3, to: [0, 0, 0] },
  },
  'ik.setRootFree': alone({ ...WHO, isFree: false }, { ...WHO, isFree: true }),
  'hold.pins': alone(
    { ...WHO, pins: [1], range: [0.5, 1.5], atSeconds: 0.5, framesPerSecond: 8 },
    { ...WHO, pins: [], range: [0.5, 1.5], atSeconds: 0.5, framesPerSecond: 8 },
  ),
  'rig.create': { document: { ...ALONE, charactersMade: 1 }, args: { name: 'new' }, idle: WHO },
  'rig.addJoint': alone({ ...WHO, parent: 1 }, { ...WHO, parent: 4 }),
  'rig.rename': alone({ ...WHO, joint: 1, name: 'wing_l' }, { ...WHO, joint: 1, name: 'arm_l' }),
  'rig.reparent': alone({ ...WHO, joint: 3, parent: 1 }, { ...WHO, joint: 3, parent: 2 }),
  'rig.remove': alone({ ...WHO, joint: 2, children: 'stay' }, { ...WHO, joint: 0, children: 'too' }),
  'rig.mirror': alone({ ...WHO, joint: 2, across: 'x' }, { ...WHO, joint: 0, across: 'x' }),
  'rig.setOffset': alone(
    { ...WHO, joint: 2, offset: [-2, 0, 0], children: 'stay' },
    { ...WHO, joint: 2, offset: [-1, 0, 0], children: 'stay' },
  ),
  'rig.setMotion': alone(
    { ...WHO, joint: 1, motion: { kind: 'hinge', axis: [0, 0, 1] } },
    { ...WHO, joint: 1, motion: { kind: 'ball', order: 'xyz' } },
  ),
  'rig.setBox': alone(
    { ...WHO, joint: 1, box: { min: [0, 0, 0], max: [1, 1, 1] } },
    { ...WHO, joint: 1, box: DEFAULT_BOX },
  ),
  'rig.setLength': alone({ ...WHO, joint: 2, length: 3 }, { ...WHO, joint: 2, length: 2 }),
  'rig.setFilePose': alone({ ...NOW, from: 'shown' }, { ...NOW, joint: 1, from: 'rest' }),
  'rig.setCouple': alone(
    { ...WHO, joint: 1, dof: 'rx', follows: FOLLOWS },
    { ...WHO, joint: 1, dof: 'rx', follows: null },
  ),
  'rig.setLimit': alone({ ...WHO, dof: 4, min: -1, max: 2 }, { ...WHO, dof: 6, min: -1, max: 1 }),
  'rig.clearLimit': alone({ ...WHO, dof: 6 }, { ...WHO, dof: 4 }),
  'attach.add': {
    document: documentOf(HERO, bee('c2')),
    args: { ...WHO, leaderId: 'c2', joint: 1, span: [0, 1] },
    idle: { ...WHO, leaderId: 'c1', joint: 1, span: [0, 1] },
  },
  'attach.change': {
    document: ATTACHED,
    args: { ...WHO, index: 0, span: [0, 2] },
    idle: { ...WHO, index: 0, span: [0.5, 1] },
  },
  'attach.remove': { document: ATTACHED, args: { ...WHO, index: 0 }, idle: { ...WHO, index: 1 } },
  'attach.putDown': { document: ATTACHED, args: NOW, idle: { ...WHO, timeSeconds: 0.25 } },
  'layers.add': alone({ ...WHO, name: 'arm', joints: [1] }, { ...WHO, joints: [9] }),
  'layers.remove': layered({ ...WHO, layer: 0 }, { ...WHO, layer: 2 }),
  'layers.rename': layered({ ...WHO, layer: 0, name: 'face' }, { ...WHO, layer: 0, name: 'arm' }),
  'layers.set': layered({ ...WHO, layer: 1, weight: 0.5, mute: true }, { ...WHO, layer: 1, weight: 1 }),
  'layers.keyWeight': layered({ ...NOW, layer: 0, weight: 0.5 }, { ...NOW, layer: 5, weight: 0.5 }),
  'layers.move': layered({ ...WHO, layer: 0, to: 1 }, { ...WHO, layer: 0, to: 0 }),
  'layers.activate': layered({ ...WHO, layer: 1 }, { ...WHO, layer: -1 }),
  'layers.mergeDown': layered({ ...WHO, layer: 1 }, { ...WHO, layer: 7 }),
  'layers.flatten': layered(WHO, { characterId: 'c2' }),
  'limbs.add': alone({ ...WHO, joints: [0, 2, 3], name: 'arm' }, { ...WHO, joints: [1, 2] }),
  'limbs.change': limbed({ ...WHO, limb: 0, name: 'wing' }, { ...WHO, limb: 0, name: 'arm' }),
  'limbs.remove': limbed({ ...WHO, limb: 0 }, { ...WHO, limb: 1 }),
  'limbs.key': limbed({ ...NOW, limb: 0, goal: [1, 2, 3, 0, 0, 0] }, { ...NOW, limb: 1, blend: 1 }),
  'limbs.switch': limbed({ ...NOW, limb: 0, to: 'fk' }, { ...NOW, limb: 0, to: 'ik' }),
  'limbs.setSpace': limbed({ ...NOW, limb: 0, space: 'arm_l' }, { ...NOW, limb: 0, space: 'world' }),
  'limbs.flatten': limbed(WHO, { characterId: 'c2' }),
  'skin.autoWeights': {
    document: SLEEVE,
    args: { ...WHO, timeSeconds: 0 },
    idle: { ...WHO, timeSeconds: 0, mostInfluences: 0 },
  },
};
