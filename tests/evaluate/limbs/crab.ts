/** A figure with limbs of every kind, for tests: a leg, a wing, an arm with limits, a tail of many joints. */
import fc from 'fast-check';
import { provideLayers } from '../../../src/evaluate/layers.ts';
import { limbInfos } from '../../../src/evaluate/limbs/infos.ts';
import { readSkel } from '../../../src/formats/skel/read.ts';
import type { Character } from '../../../src/model/document.ts';
import type { Limb, LimbMatch } from '../../../src/model/limbs.ts';
import { type Goal, type GoalChannel, restChannel, type Take } from '../../../src/model/takes/take.ts';
import { between } from '../../edit/keys/channels.ts';
import { character } from '../../helpers/builders.ts';

provideLayers();

/** `joint NAME { LINES CHILDREN }` of a `.skel`. */
const joint = (type: string, name: string, offset: string, lines = '', children = '') =>
  `${type} ${name} {\noffset ${offset}\n${lines}\n${children}\n}\n`;

const LEG = joint(
  'balljoint',
  'thigh',
  '.2 -.1 .05',
  'order yxz',
  joint(
    'hingejoint',
    'shin',
    '.05 -.5 .02',
    'axis 2 .3 -.1',
    joint(
      'balljoint',
      'foot',
      '-.02 -.55 .03',
      'order zyx',
      joint('hingejoint', 'toe', '0 -.1 .12', 'axis 1 0 0\ncouple r shin.r -0.3 0.1'),
    ),
  ),
);
const WING = joint(
  'quaternionjoint',
  'upper',
  '-.2 .2 0',
  '',
  joint('universaljoint', 'fore', '-.4 .03 .05', 'order yz', joint('quaternionjoint', 'hand', '-.35 .02 .1')),
);
const ARM = joint(
  'balljoint',
  'shoulder',
  '.2 .3 0',
  '',
  joint(
    'balljoint',
    'elbow',
    '.28 0 0',
    'rotxlimit 0 0\nrotzlimit 0 0\nrotylimit -3 .5',
    joint('balljoint', 'palm', '.25 0 0'),
  ),
);
const TAIL = ['tail1', 'tail2', 'tail3', 'tail4'].reduceRight(
  (below, name, k) => joint('hingejoint', name, '0 .05 -.3', `axis ${k % 2} ${1 - (k % 2)} 0`, below),
  '',
);

const text = joint('balljoint', 'body', '0 1.1 0', 'order zxy', LEG + WING + ARM + TAIL);
const [crab] = readSkel(new TextEncoder().encode(text), 'crab.skel').value ?? [];
export const CRAB = { ...crab, name: 'crab' };
/** Longer than the box around it. */
export const SIZE = 3;

const named = (...names: string[]) => names.map((name) => CRAB.joints.findIndex((one) => one.name === name));
/** Leg, wing, arm, tail. */
export const LIMBS: readonly Limb[] = [
  {
    ...{ name: 'leg', joints: named('thigh', 'shin', 'foot'), tip: [0, -0.02, 0.03], orient: true },
    bend: { dof: 'r', sign: 1 },
  },
  {
    ...{ name: 'wing', joints: named('upper', 'fore', 'hand'), tip: [-0.1, 0, 0], orient: false },
    bend: { dof: 'ry', sign: 1 },
  },
  {
    ...{ name: 'arm', joints: named('shoulder', 'elbow', 'palm'), tip: [0.06, 0, -0.01], orient: false },
    bend: { dof: 'ry', sign: -1 },
  },
  { name: 'tail', joints: named('tail1', 'tail2', 'tail3', 'tail4'), tip: [0, 0, -0.2], orient: false },
];

/** The character with these values of its DOFs at any time, and these goals. */
export function crabWith(values: readonly number[], goals: readonly Goal[], more: Partial<Character> = {}): Character {
  const channels = values.map((value) => restChannel(value));
  const take: Take = { name: 'walk', range: [0, 2], channels, ...(goals.length > 0 && { goals: { list: goals } }) };
  return character({ skeleton: CRAB, limbs: { list: LIMBS }, takes: [take], shownTake: 0, ...more });
}

/** A goal of constant channels. */
export function goalOf(limb: string, own: Partial<Record<GoalChannel, number>>, space: Goal['space'] = 'world'): Goal {
  const channels = Object.fromEntries(Object.entries(own).map(([name, curve]) => [name, { curve }]));
  return { limb, space, channels };
}

/** The goal that a match is. */
export function goalOfMatch(limb: string, { goal, pole, bend }: LimbMatch, space?: Goal['space']): Goal {
  const [tx, ty, tz, rx, ry, rz] = goal;
  const [px, py, pz] = pole;
  return goalOf(limb, { tx, ty, tz, rx, ry, rz, px, py, pz, bend }, space);
}

/** What a limb's goal has to be for a pose, in a space. */
export function matchFor(values: readonly number[], limb: string, space: Goal['space'] = 'world'): LimbMatch {
  const [info] = limbInfos(crabWith(values, [goalOf(limb, {}, space)], { clampsToLimits: false }), 0);
  return info.match;
}

const count = 3 + CRAB.joints.reduce((sum, { pose }) => sum + pose.length, 0);
const angle = fc.oneof(between(-3, 3), between(-3, 3), fc.constantFrom(0, Math.PI / 2, -Math.PI / 2, 1e-9, 7));
/** Any values of its DOFs, quaternions of any length among them. */
export const poses = fc.array(angle, { minLength: count, maxLength: count });
