/**
 * Humanoids of kinds that no file here has: names, rest poses, local axes, units, up axes, toes, fingers and
 * proportions drawn at random, with takes of what people do. The body, its poses and what is measured are written here
 * once more, in metres with y up and the front +z. Of retargeting, only `fitJoint` is trusted: it finds the DOFs of
 * these poses, while what is measured comes from the DOFs alone.
 */
import { compileSkeleton } from '../../../src/evaluate/kinematics.ts';
import { fitJoint, jointFit } from '../../../src/evaluate/retarget/fit.ts';
import type { Character } from '../../../src/model/document.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import { type Joint, type Motion, type Skeleton, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import type { LengthUnit, Space } from '../../../src/model/space.ts';
import { character } from '../../helpers/builders.ts';
import { degreesBetween, direction, frameTimes, median, Points, pointNames } from './captures.ts';
import { BVH_ROOT, takeOfRows } from './people.ts';

export const NAMINGS = ['mixamo', 'character1', 'biped', 'vrm'] as const;
/** The last is none: all bones are along their x axis, as in LAFAN1, and only a take tells how it stands. */
export const RESTS = ['T', 'A', 'I', 'lying', 'x'] as const;
export const UNITS = ['metres', 'centimetres', 'inches'] as const satisfies readonly LengthUnit[];
const METRES = { metres: 1, centimetres: 0.01, inches: 0.0254 } as const;

/** What a stranger looks like. */
export interface Looks {
  readonly naming: (typeof NAMINGS)[number];
  readonly rest: (typeof RESTS)[number];
  readonly up: 'y' | 'z';
  readonly unit: (typeof UNITS)[number];
  readonly isQuaternion: boolean;
  /** Whether each joint has axes of its own, by any rotation; else those of the character. */
  readonly hasOwnAxes: boolean;
  readonly hasFingers: boolean;
  readonly hasCollars: boolean;
  readonly hasMoreSpine: boolean;
  /** Whether toes are joints, else End Sites of the feet. */
  readonly hasToes: boolean;
  /** Metres, and fractions: of the leg, of its length, and of its half. */
  readonly leg: number;
  readonly arm: number;
  readonly thigh: number;
  /** Radians below the horizontal, from ankle to ball. */
  readonly slope: number;
  readonly seed: number;
}

/** What is done in a take. */
export interface Doing {
  /** Radians: of the thighs, of the knees all the time, of the trunk, and of a kick by the left leg in the middle. */
  readonly stride: number;
  readonly crouch: number;
  readonly lean: number;
  readonly kick: number;
  /** How far arms are raised: 0 by the sides, 1 level. */
  readonly arms: number;
  /** Radians a second: about the vertical, and head over heels. */
  readonly turn: number;
  readonly tumble: number;
}

type Turn = Float64Array;
type Point = readonly [number, number, number];

const SIDES = ['left', 'right'] as const;
type Side = (typeof SIDES)[number];

interface Part {
  /** `left thigh`, or `hips`. */
  readonly id: string;
  readonly above: string;
  /** From the one above, with arms in a T pose. */
  readonly way: Point;
}

/** The body in a T pose. */
function bodyOf(looks: Looks): readonly Part[] {
  const { leg, arm, thigh, slope, hasCollars, hasFingers, hasMoreSpine, hasToes } = looks;
  const up = (length: number): Point => [0, length * leg, 0];
  const spine = ['spine', 'spine1', ...(hasMoreSpine ? ['spine2', 'spine3'] : [])];
  const trunk: Part[] = [{ id: 'hips', above: '', way: [0, 0, 0] }];
  spine.forEach((id, i) => {
    trunk.push({ id, above: i > 0 ? spine[i - 1] : 'hips', way: up(i > 0 ? 0.32 / (spine.length - 1) : 0.12) });
  });
  const chest = spine[spine.length - 1];
  trunk.push({ id: 'neck', above: chest, way: up(0.22) }, { id: 'head', above: 'neck', way: up(0.12) });
  const limbs = SIDES.flatMap((side): Part[] => {
    const mirror = side === 'left' ? 1 : -1;
    const across = (x: number, y: number, z = 0): Point => [mirror * x * leg, y * leg, z * leg];
    const reach = arm * leg;
    const along = (x: number, z = 0): Point => [mirror * x * reach, 0, z * reach];
    const sole = 0.17 * leg;
    return [
      ...(hasCollars ? [{ id: `${side} collar`, above: chest, way: across(0.05, 0.17) }] : []),
      {
        id: `${side} arm`,
        above: hasCollars ? `${side} collar` : chest,
        way: hasCollars ? across(0.16, 0) : across(0.21, 0.17),
      },
      { id: `${side} forearm`, above: `${side} arm`, way: along(0.52) },
      { id: `${side} hand`, above: `${side} forearm`, way: along(0.48) },
      ...(hasFingers
        ? [
            { id: `${side} thumb`, above: `${side} hand`, way: along(0.05, 0.06) },
            { id: `${side} index`, above: `${side} hand`, way: along(0.16, 0.04) },
            { id: `${side} middle`, above: `${side} hand`, way: along(0.17) },
          ]
        : []),
      { id: `${side} thigh`, above: 'hips', way: across(0.11, -0.04) },
      { id: `${side} shin`, above: `${side} thigh`, way: [0, -thigh * leg, 0] },
      { id: `${side} foot`, above: `${side} shin`, way: [0, -(1 - thigh) * leg, 0] },
      ...(hasToes
        ? [
            {
              id: `${side} toe`,
              above: `${side} foot`,
              way: [0, -sole * Math.sin(slope), sole * Math.cos(slope)] as const,
            },
          ]
        : []),
    ];
  });
  return [...trunk, ...limbs];
}

/** The ends of chains, from their joints, with arms in a T pose; those of feet without toes are their toes. */
function endOf(id: string, { leg, arm, slope, hasToes }: Looks): Point | undefined {
  const mirror = id.startsWith('left') ? 1 : -1;
  if (id === 'head') return [0, 0.2 * leg, 0];
  if (/toe$/.test(id)) return [0, 0, 0.08 * leg];
  if (/foot$/.test(id) && !hasToes) return [0, -0.17 * leg * Math.sin(slope), 0.17 * leg * Math.cos(slope)];
  if (/thumb|index|middle/.test(id)) return [mirror * 0.08 * arm * leg, 0, 0];
  return undefined;
}

const WORDS: Readonly<Record<string, readonly [string, string, string, string]>> = {
  // As mixamo, character1, biped and vrm call them.
  hips: ['Hips', 'Hips', 'Pelvis', 'hips'],
  spine: ['Spine', 'Spine', 'Spine', 'spine'],
  spine1: ['Spine1', 'Spine1', 'Spine1', 'chest'],
  spine2: ['Spine2', 'Spine2', 'Spine2', 'upperChest'],
  spine3: ['Spine3', 'Spine3', 'Spine3', ''],
  neck: ['Neck', 'Neck', 'Neck', 'neck'],
  head: ['Head', 'Head', 'Head', 'head'],
  collar: ['Shoulder', 'Shoulder', 'Clavicle', 'Shoulder'],
  arm: ['Arm', 'Arm', 'UpperArm', 'UpperArm'],
  forearm: ['ForeArm', 'ForeArm', 'Forearm', 'LowerArm'],
  hand: ['Hand', 'Hand', 'Hand', 'Hand'],
  thumb: ['HandThumb1', 'HandThumb1', 'Finger0', 'ThumbMetacarpal'],
  index: ['HandIndex1', 'HandIndex1', 'Finger1', 'IndexProximal'],
  middle: ['HandMiddle1', 'HandMiddle1', 'Finger2', 'MiddleProximal'],
  thigh: ['UpLeg', 'UpLeg', 'Thigh', 'UpperLeg'],
  shin: ['Leg', 'Leg', 'Calf', 'LowerLeg'],
  foot: ['Foot', 'Foot', 'Foot', 'Foot'],
  toe: ['ToeBase', 'ToeBase', 'Toe0', 'Toes'],
};

function nameOf(id: string, index: number, { naming }: Looks): Pick<Joint, 'name' | 'role'> {
  const [side, part] = id.includes(' ') ? id.split(' ') : ['', id];
  const word = WORDS[part][NAMINGS.indexOf(naming)];
  const Side = side && side[0].toUpperCase() + side.slice(1);
  switch (naming) {
    case 'mixamo':
      return { name: `mixamorig:${Side}${word}` };
    case 'character1':
      return { name: `Character1_${Side}${word}` };
    case 'biped':
      return { name: ['Bip01', ...(side ? [Side[0]] : []), word].join(' ') };
    case 'vrm':
      return { name: `node${index}`, ...(word && { role: side + word }) };
  }
}

function product(...turns: readonly Turn[]): Turn {
  return turns.reduce((a, b) => {
    const out = new Float64Array(9);
    for (let c = 0; c < 3; c++) {
      for (let r = 0; r < 3; r++) for (let k = 0; k < 3; k++) out[3 * c + r] += a[3 * k + r] * b[3 * c + k];
    }
    return out;
  });
}

function back(m: Turn): Turn {
  return Float64Array.of(m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]);
}

function turned(m: Turn, [x, y, z]: Point): Point {
  return [m[0] * x + m[3] * y + m[6] * z, m[1] * x + m[4] * y + m[7] * z, m[2] * x + m[5] * y + m[8] * z];
}

const about = {
  x: (a: number) => Float64Array.of(1, 0, 0, 0, Math.cos(a), Math.sin(a), 0, -Math.sin(a), Math.cos(a)),
  y: (a: number) => Float64Array.of(Math.cos(a), 0, -Math.sin(a), 0, 1, 0, Math.sin(a), 0, Math.cos(a)),
  z: (a: number) => Float64Array.of(Math.cos(a), Math.sin(a), 0, -Math.sin(a), Math.cos(a), 0, 0, 0, 1),
};
const NOT = about.x(0);
const FROM_Y_TO_Z = about.x(Math.PI / 2);
/** How far arms hang at rest; radians. */
const DROOP = { T: 0, A: 0.8, I: 1.45, lying: 0.1, x: 0 } as const;

const isOfArm = (id: string) => /arm|hand|thumb|index|middle/.test(id);
const outwards = (id: string) => (id.startsWith('left') ? 1 : -1);

/** How parts are turned from the T pose, and where the hips are. */
interface Pose {
  readonly turnOf: (id: string) => Turn;
  readonly place: Point;
}

export interface Stranger {
  readonly character: Character;
  readonly hasToes: boolean;
  /** Index of a joint, or of what a foot ends in, among the points of `Points`; -1 for none. */
  readonly pointOf: (id: string) => number;
}

export function stranger(name: string, looks: Looks, doing: Doing): Stranger {
  const parts = bodyOf(looks);
  const at = new Map(parts.map(({ id }, j) => [id, j]));
  const scale = 1 / METRES[looks.unit];
  const toAxes = looks.up === 'z' ? FROM_Y_TO_Z : NOT;
  const lies = looks.rest === 'lying' ? about.x(-Math.PI / 2) : NOT;
  const rest: Pose = {
    turnOf: (id) => product(lies, isOfArm(id) ? about.z(-outwards(id) * DROOP[looks.rest]) : NOT),
    place: turned(lies, [0, 1.04 * looks.leg, 0]),
  };
  const random = angles(looks.seed);
  /** From the T pose to each joint's own axes. */
  const axes = parts.map(({ id }) =>
    looks.rest === 'x'
      ? alongX(parts.find(({ above }) => above === id)?.way ?? endOf(id, looks) ?? [1, 0, 0])
      : looks.hasOwnAxes
        ? product(about.x(random()), about.y(random()), about.z(random()))
        : back(product(toAxes, rest.turnOf(id))),
  );
  const inJoint = (j: number, way: Point) => scaled(turned(back(axes[j]), way), scale);
  const plain = parts.map((part, j): Joint => {
    const above = at.get(part.above) ?? -1;
    const motion: Motion =
      j === 0 ? BVH_ROOT : looks.isQuaternion ? { kind: 'quaternion' } : { kind: 'ball', order: 'xyz' };
    const end = endOf(part.id, looks);
    return {
      ...nameOf(part.id, j, looks),
      parent: above,
      offset: above < 0 ? [0, 0, 0] : inJoint(above, part.way),
      box: { min: [0, 0, 0], max: [0, 0, 0] },
      motion,
      limits: dofsOf(motion).map(() => UNLIMITED),
      pose: dofsOf(motion).map(({ rest }) => rest),
      ...(end && { endSites: [inJoint(j, end)] }),
    };
  });
  const rowOf = ({ turnOf, place }: Pose) =>
    dofsFor(
      { name, joints: plain },
      parts.map(({ id }, j) => product(toAxes, turnOf(id), axes[j])),
      scaled(turned(toAxes, place), scale),
    );
  const filed = looks.rest === 'x' ? plain.flatMap(({ pose }) => pose) : rowOf(rest);
  let next = 0;
  const joints = plain.map((joint) => {
    const first = next;
    next += joint.pose.length;
    return { ...joint, pose: filed.slice(first, next) };
  });
  const skeleton: Skeleton = { name, joints };
  const space: Space = { up: looks.up, unit: looks.unit, lift: 0 };
  const take = takeOfRows(skeleton, posesOf(parts, looks, doing).map(rowOf), FRAME);
  const made = character({ id: name, name, skeleton, takes: [take], shownTake: 0 });
  const person = { ...made, pose: filePose(skeleton, 0), space };
  const names = pointNames(person);
  const pointOf = (id: string) => {
    if (!looks.hasToes && id.endsWith('toe')) {
      return names.indexOf(`${joints[at.get(id.replace('toe', 'foot')) ?? 0].name} End Site`);
    }
    return at.get(id) ?? -1;
  };
  return { character: person, hasToes: looks.hasToes, pointOf };
}

/** Any angles, the same for one seed. */
function angles(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state * 1103515245 + 12345) % 2 ** 31;
    return (state / 2 ** 31) * 2 * Math.PI;
  };
}

/** Axes whose x is that way. */
function alongX([x, y, z]: Point): Turn {
  const flat = Math.hypot(x, z);
  return product(about.y(-Math.atan2(z, x)), about.z(Math.atan2(y, flat)));
}

function scaled([x, y, z]: Point, by: number): Point {
  return [by * x, by * y, by * z];
}

/** The DOFs of joints with these rotations in the character's axes. */
function dofsFor(skeleton: Skeleton, turns: readonly Turn[], place: Point): number[] {
  const compiled = compileSkeleton(skeleton);
  const dofs = new Float64Array(compiled.firstDof[skeleton.joints.length]);
  const first = compiled.firstDof[0];
  skeleton.joints.forEach((joint, j) => {
    const fit = jointFit(compiled, joint, j, false);
    if (!fit) return;
    const own = joint.parent < 0 ? turns[j] : product(back(turns[joint.parent]), turns[j]);
    fitJoint(compiled, j, fit, own, new Float64Array(3), 0, dofs);
  });
  dofs.set(place, first);
  return [...dofs.subarray(first)];
}

const FRAME = 1 / 30;
const SECONDS = 2;

/** Steps, with arms that do something else; the foot that is lower stays where it is, on the ground. */
function posesOf(parts: readonly Part[], looks: Looks, doing: Doing): readonly Pose[] {
  const { stride, crouch, arms, lean, kick, turn, tumble } = doing;
  const place = [0, 0, 0];
  let before: { readonly side: Side; readonly x: number; readonly z: number } | undefined;
  return Array.from({ length: Math.round(SECONDS / FRAME) + 1 }, (_, frame) => {
    const t = frame * FRAME;
    const swing = Math.sin(2 * Math.PI * t);
    const heading = product(about.y(turn * t), about.x(tumble * t));
    const turnOf = (id: string): Turn => {
      const side = outwards(id);
      const chest = product(heading, about.y(0.15 * swing), about.x(lean));
      const upper = product(chest, about.z(-side * (1.2 - arms * (0.8 + 0.4 * swing))), about.y(-0.3 * swing));
      const bend = about.y(-side * (0.5 + 0.3 * swing));
      // A foot that goes forward is lifted by its knee.
      const phase = side * swing;
      const rising = side * Math.cos(2 * Math.PI * t);
      const knee = 2 * crouch + 0.15 + stride * Math.max(0, rising);
      const kicks = side > 0 ? kick * Math.max(0, Math.sin(Math.PI * (t - 0.5))) ** 2 : 0;
      const hip = stride * phase + knee / 2 + kicks;
      const toesDown = 0.6 * stride * Math.max(0, -phase) * Math.max(0, rising);
      if (/thigh$/.test(id)) return product(heading, about.x(-hip));
      if (/shin$/.test(id)) return product(heading, about.x(knee - hip));
      if (/foot$/.test(id)) return product(heading, about.y(0.1 * side), about.x(toesDown - kicks));
      if (/toe$/.test(id)) return product(heading, about.y(0.1 * side), about.x(toesDown / 2 - kicks));
      if (/forearm$/.test(id)) return product(upper, bend);
      if (isOfArm(id) && !/arm$/.test(id)) return product(upper, bend, about.z(-side * 0.3 * swing), about.x(0.3));
      if (/arm$/.test(id)) return upper;
      if (/collar$/.test(id)) return product(chest, about.z(side * 0.1 * arms));
      if (id === 'hips') return heading;
      return id === 'head' ? product(chest, about.y(0.3 * swing)) : chest;
    };
    // Where feet are, from the hips.
    const points = new Map<string, Point>();
    for (const { id, above, way } of parts) {
      const from = points.get(above);
      const [x, y, z] = from ? turned(turnOf(above), way) : way;
      points.set(id, from ? [from[0] + x, from[1] + y, from[2] + z] : [0, 0, 0]);
    }
    const low = SIDES.map((side) => {
      const ankle = points.get(`${side} foot`) ?? [0, 0, 0];
      const [, y] = turned(turnOf(`${side} foot`), [
        0,
        -0.17 * looks.leg * Math.sin(looks.slope),
        0.17 * looks.leg * Math.cos(looks.slope),
      ]);
      return { side, x: ankle[0], z: ankle[2], y: ankle[1] + Math.min(y, -0.05 * looks.leg) };
    });
    const [left, right] = low;
    const stands = left.y < right.y ? left : right;
    const [was] = low.filter(({ side }) => side === before?.side);
    if (before && was) {
      place[0] += before.x - was.x;
      place[2] += before.z - was.z;
    }
    before = stands;
    place[1] = -stands.y;
    return { turnOf, place: [place[0], place[1], place[2]] };
  });
}

export interface StrangersFit {
  /** Degrees: medians over the frames of each segment of arms and legs, of feet, and of hands, those furthest off. */
  readonly limbs: number;
  readonly feet: number;
  readonly hands: number;
  /** The largest of feet and hands at any frame. */
  readonly tips: number;
  /** How often a toe is above its ankle while the source's is below. */
  readonly toesUp: number;
  /** What is furthest off. */
  readonly worst: string;
}

const BONES = [
  ['arm', 'forearm'],
  ['forearm', 'hand'],
  ['thigh', 'shin'],
  ['shin', 'foot'],
  ['foot', 'toe'],
  ['hand', 'middle'],
] as const;
const MEASURED = 40;
/** Sine: feet that lie on their side are neither up nor down. */
const LEVEL = 0.02;

/** @param onto the target, as it was before */
export function strangersFit(shown: Character, onto: Stranger, from: Stranger): StrangersFit {
  const [own, other] = [new Points(shown), new Points(from.character)];
  const bones = SIDES.flatMap((side) =>
    BONES.flatMap(([a, b]) => {
      const ends = ({ pointOf }: Stranger) => [pointOf(`${side} ${a}`), pointOf(`${side} ${b}`)] as const;
      const [mine, theirs] = [ends(onto), ends(from)];
      if ([...mine, ...theirs].some((point) => point < 0)) return [];
      return [{ id: `${side} ${a}`, mine, theirs, angles: [] as number[] }];
    }),
  );
  let toesUp = 0;
  for (const seconds of frameTimes(from.character, MEASURED)) {
    own.pose(seconds);
    other.pose(seconds);
    for (const { id, mine, theirs, angles } of bones) {
      const [way, meant] = [direction(own, mine), direction(other, theirs)];
      angles.push(degreesBetween(way, meant));
      if (id.endsWith('foot') && meant[1] < -LEVEL * Math.hypot(...meant) && way[1] >= 0) toesUp++;
    }
  }
  const isOf = (id: string, part: string) => id.endsWith(` ${part}`);
  const worstOf = (wanted: (id: string) => boolean) =>
    Math.max(0, ...bones.filter(({ id }) => wanted(id)).map(({ angles }) => median(angles)));
  const isTip = (id: string) => isOf(id, 'foot') || isOf(id, 'hand');
  const sorted = [...bones].sort((a, b) => median(b.angles) - median(a.angles));
  return {
    limbs: worstOf((id) => !isTip(id)),
    feet: worstOf((id) => isOf(id, 'foot')),
    hands: worstOf((id) => isOf(id, 'hand')),
    tips: Math.max(0, ...bones.filter(({ id }) => isTip(id)).flatMap(({ angles }) => angles)),
    toesUp,
    worst: sorted
      .slice(0, 4)
      .map(({ id, angles }) => `${id} ${median(angles).toFixed(1)}`)
      .join(', '),
  };
}
