/** Real captures retargeted to each other, and how far the result is from what was meant, measured on the joints. */
import { setRetarget } from '../../../src/edit/commands/retarget.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { type PoseSource, poseFrom, poseSource } from '../../../src/evaluate/pose.ts';
import { applySpace } from '../../../src/evaluate/space/space.ts';
import { guessSpace } from '../../../src/evaluate/space/space-guess.ts';
import { type Character, findCharacter, shownTake } from '../../../src/model/document.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { positionsMeant, withPositions } from '../../../src/model/skeleton/position-channels.ts';
import type { RetargetOptions } from '../../../src/model/takes/retarget.ts';
import { character, documentOf } from '../../helpers/builders.ts';
import { sharedCaptures } from '../../helpers/bvh-files.ts';

/** Joints of the left side in each humanoid: arm, forearm, hand, thigh, shin, foot, and the toe or nothing. */
const LIMBS: Readonly<Record<string, readonly string[]>> = {
  'bandai-namco-bow-normal.bvh': ['UpperArm_L', 'LowerArm_L', 'Hand_L', 'UpperLeg_L', 'LowerLeg_L', 'Foot_L', 'Toes_L'],
  'boxing-extra-line.bvh': ['LeftShoulder', 'LeftElbow', 'LeftWrist', 'LeftHip', 'LeftKnee', 'LeftAnkle', 'LeftToes'],
  'cmu-01_01.bvh': ['LeftArm', 'LeftForeArm', 'LeftHand', 'LeftUpLeg', 'LeftLeg', 'LeftFoot', 'LeftToeBase'],
  'cmu-daz-pirouette.bvh': ['lShldr', 'lForeArm', 'lHand', 'lThigh', 'lShin', 'lFoot'],
  'geno-stance.bvh': ['LeftArm', 'LeftForeArm', 'LeftHand', 'LeftUpLeg', 'LeftLeg', 'LeftFoot', 'LeftToeBase'],
  'lafan1-dance-10frames.bvh': ['LeftArm', 'LeftForeArm', 'LeftHand', 'LeftUpLeg', 'LeftLeg', 'LeftFoot', 'LeftToe'],
  'makehuman-tpose-add.bvh': ['upperarm01.L', 'lowerarm01.L', 'wrist.L', 'upperleg01.L', 'lowerleg01.L', 'foot.L'],
  'mixamo-names.bvh': [
    'mixamorig:LeftArm',
    'mixamorig:LeftForeArm',
    'mixamorig:LeftHand',
    'mixamorig:LeftUpLeg',
    'mixamorig:LeftLeg',
    'mixamorig:LeftFoot',
    'mixamorig:LeftToeBase',
  ],
  'no-end-sites.bvh': ['lhumerus', 'lradius', 'lhand', 'lfemur', 'ltibia', 'lfoot', 'ltoes'],
  'openni-kinect-hash-names.bvh': ['LEFT_SHOULDER#', 'LEFT_ELBOW', 'LEFT_HAND', 'LEFT_HIP#', 'LEFT_KNEE', 'LEFT_FOOT'],
  'perception-neuron-course.bvh': ['LeftArm', 'LeftForeArm', 'LeftHand', 'LeftUpLeg', 'LeftLeg', 'LeftFoot'],
  'poser-sl-walk.bvh': ['lShldr', 'lForeArm', 'lHand', 'lThigh', 'lShin', 'lFoot'],
  'rokoko-dance.bvh': ['LeftArm', 'LeftForeArm', 'LeftHand', 'LeftUpLeg', 'LeftLeg', 'LeftFoot', 'LeftToeBase'],
  'xsens-armchair.bvh': ['LeftShoulder', 'LeftElbow', 'LeftWrist', 'LeftHip', 'LeftKnee', 'LeftAnkle', 'LeftToe'],
};

/** Where the left middle finger begins. */
const FINGERS: Readonly<Record<string, string>> = {
  'cmu-daz-pirouette.bvh': 'lMid1',
  'geno-stance.bvh': 'LeftHandMiddle1',
  'makehuman-tpose-add.bvh': 'finger3-1.L',
  'mixamo-names.bvh': 'mixamorig:LeftHandMiddle1',
  'perception-neuron-course.bvh': 'LeftHandMiddle1',
  'rokoko-dance.bvh': 'LeftHandMiddle1',
};

export const HUMANOIDS: readonly string[] = Object.keys(LIMBS);

const known = new Map<string, Character>();

/** Its first character as a character, position channels as its writer meant them; made once. */
export function captured(file: string, id = file): Character {
  const found = known.get(`${id} ${file}`) ?? madeOf(file, id);
  known.set(`${id} ${file}`, found);
  return found;
}

function madeOf(file: string, id: string): Character {
  const [{ skeleton: read, take }] = sharedCaptures(file);
  const skeleton = withPositions(read, positionsMeant(read, take));
  return {
    ...character({ id, name: id, skeleton, takes: take ? [take] : [], shownTake: take ? 0 : -1 }),
    pose: filePose(skeleton, 0),
    space: guessSpace(skeleton, take),
  };
}

export function retargeted(source: Character, target: Character, options?: Partial<RetargetOptions>): Character {
  const document = setRetarget.run(documentOf(source, target), {
    characterId: target.id,
    sourceId: source.id,
    options,
  });
  const found = findCharacter(document, target.id);
  if (!found) throw new Error(`${target.id} is gone.`);
  return found;
}

/** Poses a character at times, and gives points of it in the scene: metres, y up. */
export class Points {
  /** x y z of each joint, then of each End Site. */
  readonly at: Float64Array;
  private readonly character: Character;
  private readonly dofs: Float64Array;
  private readonly world: Float64Array;
  private readonly source: PoseSource;
  /** By seconds, where they are kept. */
  private readonly kept: Map<number, Float64Array> | undefined;

  /** @param keeps whether what was posed once is kept, for those that are posed at the same times again and again */
  constructor(character: Character, keeps = false) {
    this.character = character;
    this.kept = keeps ? new Map() : undefined;
    const { joints } = requireSkeleton(character);
    this.source = poseSource(character);
    this.dofs = new Float64Array(this.source.count);
    this.world = new Float64Array(16 * joints.length);
    this.at = new Float64Array(3 * pointNames(character).length);
  }

  pose(seconds: number): void {
    const { character, dofs, world, at, kept } = this;
    const known = kept?.get(seconds);
    if (known) {
      at.set(known);
      return;
    }
    const skeleton = requireSkeleton(character);
    poseFrom(this.source, seconds, dofs);
    worldMatrices(compileSkeleton(skeleton), dofs, world);
    const p = new Float64Array(3);
    let next = 3 * skeleton.joints.length;
    skeleton.joints.forEach(({ endSites }, j) => {
      const o = 16 * j;
      applySpace(character.space, world[o + 12], world[o + 13], world[o + 14], p);
      at.set(p, 3 * j);
      for (const [x, y, z] of endSites ?? []) {
        const along = (k: number) => world[o + k] * x + world[o + 4 + k] * y + world[o + 8 + k] * z + world[o + 12 + k];
        applySpace(character.space, along(0), along(1), along(2), p);
        at.set(p, next);
        next += 3;
      }
    });
    kept?.set(seconds, at.slice());
  }

  /** From the lowest point to the highest. */
  height(): number {
    let low = Infinity;
    let high = -Infinity;
    for (let i = 1; i < this.at.length; i += 3) {
      low = Math.min(low, this.at[i]);
      high = Math.max(high, this.at[i]);
    }
    return high - low;
  }
}

export function requireSkeleton({ name, skeleton }: Character) {
  if (!skeleton) throw new Error(`${name} has no skeleton.`);
  return skeleton;
}

/** Of the points of `Points`. */
export function pointNames(character: Character): readonly string[] {
  const { joints } = requireSkeleton(character);
  return [
    ...joints.map(({ name }) => name),
    ...joints.flatMap(({ name, endSites }) => (endSites ?? []).map(() => `${name} End Site`)),
  ];
}

/** Seconds of the transport at each frame of the shown take. */
export function frameTimes(character: Character, most = Infinity): readonly number[] {
  const take = shownTake(character);
  if (!take?.samples) throw new Error(`${character.name} has no samples.`);
  const { frameCount, frameSeconds, startSeconds } = take.samples;
  const count = Math.min(most, frameCount);
  return Array.from(
    { length: count },
    (_, i) => startSeconds + frameSeconds * Math.round((i * (frameCount - 1)) / Math.max(1, count - 1)),
  );
}

export interface Departure {
  /** Distance of the worst point, metres, and as a fraction of the character's height. */
  readonly metres: number;
  readonly share: number;
  readonly point: string;
  readonly seconds: number;
}

/** How far a character's points are from another's of the same skeleton, at every frame of that one's take. */
export function departure(of: Character, from: Character): Departure {
  const [own, other] = [new Points(of), new Points(from)];
  const names = pointNames(from);
  let worst = { metres: 0, point: '', seconds: 0 };
  let height = 0;
  for (const seconds of frameTimes(from)) {
    own.pose(seconds);
    other.pose(seconds);
    height = Math.max(height, other.height());
    for (let i = 0; i < names.length; i++) {
      const metres = Math.hypot(
        own.at[3 * i] - other.at[3 * i],
        own.at[3 * i + 1] - other.at[3 * i + 1],
        own.at[3 * i + 2] - other.at[3 * i + 2],
      );
      if (!(metres <= worst.metres)) worst = { metres, point: names[i], seconds };
    }
  }
  return { ...worst, share: worst.metres / height };
}

const PARTS = ['arm', 'forearm', 'hand', 'thigh', 'shin', 'foot', 'toe'] as const;
type Part = (typeof PARTS)[number];
const SEGMENTS: readonly (readonly [Part, Part])[] = [
  ['arm', 'forearm'],
  ['forearm', 'hand'],
  ['thigh', 'shin'],
  ['shin', 'foot'],
];
const SIDES = ['left', 'right'] as const;
type Side = (typeof SIDES)[number];

/** Index of a limb's joint in a humanoid of `data/bvh`. */
export function limbJoint(c: Character, side: Side, part: Part): number | undefined {
  return jointOf(c, side, LIMBS[c.id.replace(/ copy$/, '')]?.[PARTS.indexOf(part)]);
}

function jointOf({ id, skeleton }: Character, side: Side, left: string | undefined) {
  if (left === undefined) return undefined;
  const name = side === 'left' ? left : mirrored(left);
  const joint = skeleton?.joints.findIndex((j) => j.name === name) ?? -1;
  if (joint < 0) throw new Error(`${id} has no ${name}.`);
  return joint;
}

/** What a foot points to, as a point of `Points`: the toe joint, else the End Site, as long as it is somewhere else. */
function toeOf(c: Character, side: Side): number | undefined {
  const [foot, toe] = [limbJoint(c, side, 'foot'), limbJoint(c, side, 'toe')];
  if (foot === undefined || toe !== undefined) return toe;
  const { joints } = requireSkeleton(c);
  const [end] = joints[foot].endSites ?? [];
  if (end && Math.hypot(...end) > 0) return pointNames(c).indexOf(`${joints[foot].name} End Site`);
  const below = joints.findIndex(({ parent }) => parent === foot);
  return below < 0 ? undefined : below;
}

function mirrored(left: string): string {
  if (/[._]L$/.test(left)) return `${left.slice(0, -1)}R`;
  return left.replace('Left', 'Right').replace('LEFT', 'RIGHT').replace(/^l/, 'r');
}

export interface PairFit {
  /** Degrees between equal parts, medians over the frames: the segment of arms and legs, of either side, that is furthest off. */
  readonly limbs: number;
  /** The same for each foot and each hand, from the ankle to the toe and from the wrist to the middle finger; 0 without. */
  readonly feet: number;
  readonly hands: number;
  /** The largest angle of a foot or a hand at any frame. */
  readonly tips: number;
  /** How often a toe is above its ankle while the source's is below. */
  readonly toesUp: number;
  /** Degrees between the same segments of arms and legs, each the mean over the frames: median and maximum. */
  readonly median: number;
  readonly worst: number;
  /** The segment that is furthest off. */
  readonly segment: string;
  /** Of the height of the hips above the lower ankle in leg lengths: the mean difference over the frames. */
  readonly hips: number;
  /** How far feet slide over the ground during contacts of the source, in leg lengths: mean of both, then the maximum. */
  readonly slide: number;
  readonly sourceSlide: number;
  readonly worstSlide: number;
  readonly worstSourceSlide: number;
  readonly contacts: number;
}

/** Frames examined for directions. */
const DIRECTIONS = 60;
/** Of the source's ankle or toe, in leg lengths a second; a contact is at least that many seconds long. */
const SLOW = 0.15;
const LOW = 0.06;
const SHORTEST = 0.15;
/** Frames examined for contacts. */
const CONTACTS = 600;

/** Sources, each of which is compared with a dozen characters. */
const sources = new WeakMap<Character, Points>();

function sourcePoints(from: Character): Points {
  const points = sources.get(from) ?? new Points(from, true);
  sources.set(from, points);
  return points;
}

/** Measures a retargeted humanoid of `data/bvh` against its source. */
export function pairFit(of: Character, from: Character): PairFit {
  const [own, other] = [new Points(of), sourcePoints(from)];
  const joint = (c: Character, side: Side, part: Part) => {
    const found = limbJoint(c, side, part);
    if (found === undefined) throw new Error(`${c.id} has no ${side} ${part}.`);
    return found;
  };
  const segments = SIDES.flatMap((side) =>
    SEGMENTS.map(([a, b]) => ({
      name: `${side} ${a}`,
      own: [joint(of, side, a), joint(of, side, b)] as const,
      other: [joint(from, side, a), joint(from, side, b)] as const,
      sum: 0,
    })),
  );
  const stance = (points: Points, c: Character) => {
    const y = (side: Side, part: Part) => points.at[3 * joint(c, side, part) + 1];
    const hips = (y('left', 'thigh') + y('right', 'thigh')) / 2;
    return (hips - Math.min(y('left', 'foot'), y('right', 'foot'))) / leg(points, c);
  };
  const leg = (points: Points, c: Character) => {
    const lengths = SIDES.map((side) => {
      const [thigh, shin, foot] = (['thigh', 'shin', 'foot'] as const).map((part) => joint(c, side, part));
      return distance(points, thigh, shin) + distance(points, shin, foot);
    });
    return (lengths[0] + lengths[1]) / 2;
  };
  const times = frameTimes(from, DIRECTIONS);
  let hips = 0;
  for (const seconds of times) {
    own.pose(seconds);
    other.pose(seconds);
    for (const segment of segments) {
      segment.sum += degreesBetween(direction(own, segment.own), direction(other, segment.other));
    }
    hips += Math.abs(stance(own, of) - stance(other, from)) / times.length;
  }
  const angles = segments.map(({ name, sum }) => ({ name, angle: sum / times.length }));
  angles.sort((a, b) => a.angle - b.angle);
  const worst = angles[angles.length - 1];
  const middle = angles.length / 2;
  return {
    median: (angles[Math.floor(middle - 0.5)].angle + angles[Math.floor(middle)].angle) / 2,
    worst: worst.angle,
    segment: worst.name,
    hips,
    ...partsFit(own, of, other, from),
    ...slides(own, of, other, from, leg(own, of), leg(other, from)),
  };
}

/** Medians, which a few frames don't change. */
function partsFit(own: Points, of: Character, other: Points, from: Character) {
  const limbs = SIDES.flatMap((side) => SEGMENTS.map((parts) => ({ side, parts, angles: [] as number[] })));
  const tips = [(c: Character, side: Side) => toeOf(c, side), fingerOf].flatMap((tipOf, i) =>
    SIDES.flatMap((side) => {
      const base = i === 0 ? 'foot' : 'hand';
      const [a, b, c, d] = [limbJoint(of, side, base), tipOf(of, side), limbJoint(from, side, base), tipOf(from, side)];
      if (a === undefined || b === undefined || c === undefined || d === undefined) return [];
      return [{ isFoot: i === 0, own: [a, b] as const, other: [c, d] as const, angles: [] as number[] }];
    }),
  );
  let toesUp = 0;
  for (const seconds of frameTimes(from, DIRECTIONS)) {
    own.pose(seconds);
    other.pose(seconds);
    for (const { side, parts, angles } of limbs) {
      const ends = (c: Character) => [limbJoint(c, side, parts[0]) ?? 0, limbJoint(c, side, parts[1]) ?? 0] as const;
      angles.push(degreesBetween(direction(own, ends(of)), direction(other, ends(from))));
    }
    for (const tip of tips) {
      const [way, meant] = [direction(own, tip.own), direction(other, tip.other)];
      tip.angles.push(degreesBetween(way, meant));
      if (tip.isFoot && meant[1] < 0 && way[1] >= 0) toesUp++;
    }
  }
  const worstOf = (isFoot: boolean) =>
    Math.max(0, ...tips.filter((tip) => tip.isFoot === isFoot).map(({ angles }) => median(angles)));
  return {
    limbs: Math.max(...limbs.map(({ angles }) => median(angles))),
    feet: worstOf(true),
    hands: worstOf(false),
    tips: Math.max(0, ...tips.flatMap(({ angles }) => angles)),
    toesUp,
  };
}

function fingerOf(c: Character, side: Side): number | undefined {
  return jointOf(c, side, FINGERS[c.id.replace(/ copy$/, '')]);
}

export function median(values: readonly number[]): number {
  return [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
}

/** Contacts are found by the toes where both have them, else by the ankles. */
function slides(own: Points, of: Character, other: Points, from: Character, ownLeg: number, otherLeg: number) {
  const times = frameTimes(from, CONTACTS);
  const step = times.length > 1 ? times[1] - times[0] : 0;
  const feet = SIDES.map((side) => {
    const hasToes = limbJoint(of, side, 'toe') !== undefined && limbJoint(from, side, 'toe') !== undefined;
    const part = hasToes ? 'toe' : 'foot';
    return { own: limbJoint(of, side, part) ?? 0, other: limbJoint(from, side, part) ?? 0 };
  });
  const paths = feet.map(() => ({ own: [] as number[][], other: [] as number[][] }));
  for (const seconds of times) {
    own.pose(seconds);
    other.pose(seconds);
    feet.forEach((foot, i) => {
      paths[i].own.push([0, 1, 2].map((k) => own.at[3 * foot.own + k] / ownLeg));
      paths[i].other.push([0, 1, 2].map((k) => other.at[3 * foot.other + k] / otherLeg));
    });
  }
  const slid: number[] = [];
  const sourceSlid: number[] = [];
  for (const path of paths) {
    const heights = path.other.map((p) => p[1]).sort((a, b) => a - b);
    const ground = heights[Math.floor(0.12 * heights.length)];
    let start = 0;
    for (let f = 1; f <= path.other.length; f++) {
      const isSlow =
        f < path.other.length &&
        Math.hypot(...path.other[f].map((v, k) => v - path.other[f - 1][k])) < SLOW * step &&
        path.other[f][1] < ground + LOW;
      if (isSlow) continue;
      if ((f - 1 - start) * step >= SHORTEST) {
        slid.push(spread(path.own.slice(start, f)));
        sourceSlid.push(spread(path.other.slice(start, f)));
      }
      start = f;
    }
  }
  const mean = (values: readonly number[]) => values.reduce((a, b) => a + b, 0) / Math.max(1, values.length);
  return {
    slide: mean(slid),
    sourceSlide: mean(sourceSlid),
    worstSlide: Math.max(0, ...slid),
    worstSourceSlide: Math.max(0, ...sourceSlid),
    contacts: slid.length,
  };
}

/** Furthest over the ground from the first. */
function spread(points: readonly (readonly number[])[]): number {
  return Math.max(...points.map((p) => Math.hypot(p[0] - points[0][0], p[2] - points[0][2])));
}

function distance({ at }: Points, a: number, b: number): number {
  return Math.hypot(...[0, 1, 2].map((k) => at[3 * a + k] - at[3 * b + k]));
}

export function direction({ at }: Points, [a, b]: readonly [number, number]): readonly number[] {
  return [0, 1, 2].map((k) => at[3 * b + k] - at[3 * a + k]);
}

export function degreesBetween(a: readonly number[], b: readonly number[]): number {
  const dot = a.reduce((sum, v, k) => sum + v * b[k], 0);
  return (180 / Math.PI) * Math.acos(Math.min(1, Math.max(-1, dot / (Math.hypot(...a) * Math.hypot(...b)))));
}
