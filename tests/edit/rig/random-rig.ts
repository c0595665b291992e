/** Random characters with everything that refers to joints and DOFs, and rigging commands to try on them. */
import fc from 'fast-check';
import type { Change } from '../../../src/edit/change.ts';
import type { Command } from '../../../src/edit/command.ts';
import { ALL_COMMANDS } from '../../../src/edit/commands/all.ts';
import { provideSources } from '../../../src/edit/follow/sources.ts';
import { provideRetargeting } from '../../../src/evaluate/retarget/driving.ts';
import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Character, Document } from '../../../src/model/document.ts';
import { filePose, rootDofCount } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import {
  AXIS_PAIRS,
  type BvhChannel,
  COMPOUND_DOFS,
  type Couple,
  DEFAULT_BOX,
  EULER_ORDERS,
  type Joint,
  type Limit,
  type Motion,
  SCALE_MODES,
  type Skeleton,
  UNLIMITED,
} from '../../../src/model/skeleton/skeleton.ts';
import { oneSurface, type Skin } from '../../../src/model/skin.ts';
import type { Samples } from '../../../src/model/takes/samples.ts';
import { type Channel, followingSamples, restChannel, type Take } from '../../../src/model/takes/take.ts';
import { character, documentOf, morph } from '../../helpers/builders.ts';
import { Dice } from '../dice.ts';
import { channelOf } from '../keys/channels.ts';

// Some characters are driven by another's take.
provideSources();
provideRetargeting();

/** Numbers from 0 up to 1, as many as are asked for, that follow from one (a linear congruential generator). */
export function diceOf(seed: number): Dice {
  let state = seed >>> 0;
  const numbers = Array.from({ length: 1024 }, () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  });
  return new Dice(numbers);
}

export const seeds = fc.noBias(fc.nat(2 ** 32 - 1));

const part = (dice: Dice) => Math.round((dice.number() - 0.5) * 64) / 16;
const vector = (dice: Dice): Vec3 => [part(dice), part(dice), part(dice)];

function axis(dice: Dice): Vec3 {
  const v = vector(dice);
  return v.some((k) => k !== 0) ? v : [0, 1, 0];
}

const BVH: readonly BvhChannel[] = ['tx', 'ty', 'tz', 'rx', 'ry', 'rz'];

export function randomBvhMotion(dice: Dice, positions: 'replace' | 'add'): Motion {
  return { kind: 'bvh', channels: dice.some(BVH, 0.7).sort(() => dice.number() - 0.5), positions };
}

/** Of any kind that `.skel` has. */
export function randomMotion(dice: Dice): Motion {
  const order = dice.pick(EULER_ORDERS);
  return dice.pick<Motion>([
    { kind: 'ball', order },
    { kind: 'ball', order: 'xyz' },
    { kind: 'hinge', axis: axis(dice) },
    { kind: 'universal', order: dice.pick(AXIS_PAIRS) },
    { kind: 'quaternion' },
    { kind: 'prismatic', axis: axis(dice) },
    { kind: 'translational' },
    { kind: 'free', order },
    { kind: 'screw', axis: axis(dice), pitch: part(dice) },
    { kind: 'scale', mode: dice.pick(SCALE_MODES), axis: axis(dice) },
    { kind: 'shear' },
    { kind: 'fixed' },
    { kind: 'compound', dofs: dice.some(COMPOUND_DOFS, 0.4) },
  ]);
}

/** A value for a DOF, near enough to its rest that nothing is scaled to nothing. */
export function randomValue(dice: Dice, rest: number): number {
  return rest + (dice.number() - 0.5) * (rest === 1 ? 1 : 2);
}

function randomJoint(dice: Dice, index: number, parent: number, motion: Motion): Joint {
  const dofs = dofsOf(motion);
  // Position channels of motion capture are read without any limits.
  const none = motion.kind === 'bvh' && dice.is(0.5) ? { min: -Infinity, max: Infinity } : UNLIMITED;
  const limit = (): Limit => (dice.is(0.7) ? none : { min: -1 - dice.number(), max: 1 + dice.number() });
  return {
    name: dice.is(0.9) ? `bone${index}${dice.pick(['', '_l', '_r'])}` : '',
    parent,
    offset: vector(dice),
    box: dice.is(0.5) ? DEFAULT_BOX : { min: vector(dice), max: vector(dice) },
    motion,
    limits: dofs.map(limit),
    pose: dofs.map(({ rest }) => (dice.is(0.5) ? rest : randomValue(dice, rest))),
    ...(dice.is(0.2) && { length: dice.number() }),
  };
}

export function randomSkeleton(dice: Dice, isBvh = false): Skeleton {
  const count = 1 + dice.below(8);
  const positions = dice.pick(['replace', 'add'] as const);
  const joints: Joint[] = [];
  for (let j = 0; j < count; j++) {
    const line: number[] = [];
    for (let above = j - 1; above >= 0; above = joints[above].parent) line.push(above);
    const parent = line.length ? dice.pick(line) : -1;
    joints.push(randomJoint(dice, j, parent, isBvh ? randomBvhMotion(dice, positions) : randomMotion(dice)));
  }
  return { name: 'hero', joints: isBvh ? joints : coupled(dice, joints) };
}

/** Some DOFs that follow others before them: never round and round. */
function coupled(dice: Dice, joints: readonly Joint[]): readonly Joint[] {
  const all = joints.flatMap(({ motion }, joint) => dofsOf(motion).map(({ name }) => ({ joint, name })));
  return joints.map((joint, j) => {
    const couples = all.flatMap(({ joint: owner, name }, i): Couple[] => {
      if (owner !== j || i === 0 || joint.motion.kind === 'quaternion' || !dice.is(0.15)) return [];
      const followed = all[dice.below(i)];
      return [{ dof: name, joint: followed.joint, follows: followed.name, gain: 0.5, offset: 0.25 }];
    });
    return couples.length ? { ...joint, couples } : joint;
  });
}

function randomSkin(dice: Dice, name: string, joints: number): Skin {
  const bound = dice.is(0.8) ? joints : 1 + dice.below(joints);
  const vertices = 1 + dice.below(6);
  const start = [0];
  const owners: number[] = [];
  const weights: number[] = [];
  for (let v = 0; v < vertices; v++) {
    const count = dice.below(4);
    for (let a = 0; a < count; a++) {
      owners.push(dice.below(bound));
      weights.push(a === 0 ? 1 - 0.25 * (count - 1) : 0.25);
    }
    start.push(owners.length);
  }
  const bindings = new Float64Array(16 * bound);
  for (let o = 0; o < bindings.length; o += 16) {
    bindings.set([0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, ...vector(dice), 1], o);
  }
  return {
    name,
    positions: Float64Array.from({ length: 3 * vertices }, () => part(dice)),
    normals: Float64Array.from({ length: 3 * vertices }, (_, i) => (i % 3 === 2 ? 1 : part(dice))),
    ...(dice.is(0.85) && {
      attachments: {
        start: Uint32Array.from(start),
        joints: Uint32Array.from(owners),
        weights: Float64Array.from(weights),
      },
    }),
    triangles: new Uint32Array(0),
    surfaces: oneSurface(new Uint32Array(0)),
    bindings,
  };
}

function randomTake(dice: Dice, skeleton: Skeleton, dofs: number): Take {
  const rests = filePose(skeleton, dofs);
  const count = dice.is(0.7) ? dofs + dice.below(2) : dice.below(dofs);
  const channels = Array.from({ length: count }, (_, c): Channel => {
    const rest = rests[c] ?? 0;
    if (dice.is(0.5)) return restChannel(rest);
    return channelOf([0, 1, 2].map((time) => [time, rest + dice.number() / 4] as const));
  });
  const take = { name: 'hero_walk', range: [0, 2] as const, channels };
  if (count === 0 || dice.is(0.4)) return take;
  const first = dice.below(count);
  const width = 1 + dice.below(count - first);
  const samples: Samples = {
    frameCount: 4,
    frameSeconds: 0.5,
    startSeconds: 0,
    firstChannel: first,
    values: Float64Array.from({ length: 4 * width }, (_, i) => (rests[first + (i % width)] ?? 0) * 40 + dice.number()),
    scales: Float64Array.from({ length: width }, () => dice.pick([RADIANS_PER_DEGREE, 0.025])),
    interpolation: dice.pick(['nearest', 'linear'] as const),
  };
  return { ...take, channels: followingSamples(channels, samples), samples };
}

/** One that has all there is, and another that its take moves. */
export function randomDocument(seed: number): Document {
  const dice = diceOf(seed);
  const skeleton = randomSkeleton(dice, dice.is(0.25));
  const morphs = dice.is(0.5) ? [morph('smile')] : [];
  const pose = filePose(skeleton, morphs.length).map((value) => value + (dice.is(0.5) ? 0 : (dice.number() - 0.5) / 2));
  const takes = dice.is(0.6) ? [randomTake(dice, skeleton, pose.length), randomTake(dice, skeleton, pose.length)] : [];
  const joint = () => dice.below(skeleton.joints.length);
  const hero = character({
    skeleton,
    morphs,
    pose,
    skins: [
      randomSkin(dice, 'hero', skeleton.joints.length),
      ...(dice.is(0.3) ? [randomSkin(dice, 'b', skeleton.joints.length)] : []),
    ],
    takes,
    shownTake: takes.length - 1,
    clampsToLimits: dice.is(0.7),
    ...(dice.is(0.5) && {
      unkeyed: { timeSeconds: 1, dofs: [0, pose.length - 1].slice(0, pose.length), values: [0.1, 0.2] },
    }),
    ...(dice.is(0.5) && { poses: [{ name: 'wave', values: pose.map((value) => value / 2) }] }),
    ik: {
      pins: [
        { id: 1, joint: joint(), point: [0, 0, 0], weight: 1, holdsOrientation: false },
        { id: 2, joint: joint(), point: [1, 0, 0], weight: 2, holdsOrientation: true },
      ],
      stiff: [{ joint: joint() }],
      rootIsFree: true,
    },
  });
  return { ...documentOf(hero, ...(takes.length ? [follower(dice, hero, skeleton)] : [])), charactersMade: 2 };
}

function follower(dice: Dice, hero: Character, skeleton: Skeleton): Character {
  const own = character({ id: 'c2', name: 'bee' });
  const take = hero.takes[hero.shownTake];
  const { name, pose, clampsToLimits, timeOffsetSeconds } = hero;
  return {
    ...own,
    driver: {
      sourceId: hero.id,
      source: { name, skeleton, take, pose, clampsToLimits, timeOffsetSeconds },
      pairs: [
        { target: 0, source: 0 },
        { target: 1, source: dice.below(skeleton.joints.length) },
      ],
      options: { reference: 'rest', plantsFeet: false },
    },
  };
}

export const RIG_COMMANDS = [
  'rig.addJoint',
  'rig.rename',
  'rig.reparent',
  'rig.remove',
  'rig.mirror',
  'rig.setOffset',
  'rig.setMotion',
  'rig.setBox',
  'rig.setLength',
  'rig.setFilePose',
  'rig.setLimit',
  'rig.clearLimit',
  'rig.setCouple',
] as const;
export type RigCommand = (typeof RIG_COMMANDS)[number];

/** Arguments for it; some are refused, as some of what people ask for is. */
export function rigArguments(id: RigCommand, { skeleton }: Character, dice: Dice, more: object = {}): object {
  const count = skeleton?.joints.length ?? 0;
  const joint = dice.below(count);
  const modes = { skin: dice.pick(['stays', 'follows']), timeSeconds: dice.pick([0, 1]) };
  return { characterId: 'c1', joint, ...modes, ...ownArguments(id, skeleton, joint, dice), ...more };
}

const NO_DOFS: Motion = { kind: 'fixed' };

function randomDof(skeleton: Skeleton | undefined, dice: Dice): number {
  return dice.below(1 + (skeleton ? jointDofs(skeleton) : 0));
}

function ownArguments(id: RigCommand, skeleton: Skeleton | undefined, joint: number, dice: Dice): object {
  const count = skeleton?.joints.length ?? 0;
  switch (id) {
    case 'rig.addJoint':
      return {
        parent: joint,
        ...(dice.is(0.5) && { offset: vector(dice) }),
        ...(dice.is(0.3) && { name: 'a b' }),
      };
    case 'rig.rename':
      return { name: dice.pick(['hip', '', 'left {arm}', 'leg_l']) };
    case 'rig.reparent': {
      const parent = dice.below(count);
      const siblings = [...(skeleton?.joints.entries() ?? [])].filter(([, j]) => j.parent === parent).map(([j]) => j);
      return { parent, ...(siblings.length && dice.is(0.5) && { before: dice.pick(siblings) }) };
    }
    case 'rig.remove':
      return { children: dice.pick(['too', 'stay', 'stay']) };
    case 'rig.mirror':
      return { across: dice.pick(['x', 'y', 'z']) };
    case 'rig.setOffset':
      return { offset: vector(dice), children: dice.pick(['follow', 'stay']) };
    case 'rig.setMotion':
      return {
        motion: dice.is(0.8) ? randomMotion(dice) : randomBvhMotion(dice, dice.pick(['replace', 'add'])),
      };
    case 'rig.setBox':
      return { box: { min: vector(dice), max: vector(dice) } };
    case 'rig.setLength':
      return { length: dice.is(0.3) ? null : dice.number() };
    case 'rig.setLimit':
      return { dof: randomDof(skeleton, dice), min: -dice.number() / 4, max: dice.number() / 4 };
    case 'rig.clearLimit':
      return { dof: randomDof(skeleton, dice) };
    case 'rig.setCouple': {
      const name = (j: number) => dice.pick([...dofsOf(skeleton?.joints[j]?.motion ?? NO_DOFS), { name: 'rx' }]).name;
      const other = dice.below(count);
      const follows = { joint: other, dof: name(other), gain: part(dice) / 4, offset: part(dice) / 16 };
      return { dof: name(joint), follows: dice.is(0.2) ? null : follows };
    }
    case 'rig.setFilePose':
      return { ...(dice.is(0.5) && { joint: undefined }), from: dice.pick(['shown', 'rest']) };
  }
}

/** A command by its id, to be given arguments that no compiler looked at. */
export function rigCommand(id: string): Command<object, Document | Change> {
  const command = ALL_COMMANDS.get(id);
  if (!command) throw new Error(`There is no command ${id}.`);
  // As from the console: it checks its arguments itself.
  return command as unknown as Command<object, Document | Change>;
}

/** The DOFs of the joints and the root translation. */
export function jointDofs(skeleton: Skeleton): number {
  return rootDofCount(skeleton) + skeleton.joints.reduce((sum, { motion }) => sum + dofsOf(motion).length, 0);
}
