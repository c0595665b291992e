/**
 * How feet stand. Bones say little about soles: from ankle to ball they slope by 10° in one skeleton and by 40° in
 * another, and both soles are flat. So soles are aligned rather than bones, as far as the bones don't differ by more
 * than feet of people do; and where a pose doesn't tell how a sole lies, the bones.
 */
import { copy3, multiply3, swing, turnAbout, turnVector } from '../../math/mat3.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import { metresPerUnit } from '../space/metres.ts';
import { distance, type RetargetBody } from './body.ts';
import type { BodyParts } from './roles.ts';
import { footTip, type PointTree, tipBelow } from './tip.ts';

/** A joint that points somewhere, with all below it. */
export interface PointedJoints {
  /** The joint itself is first. */
  readonly joints: readonly number[];
  /** Target that it points to: another joint, or a point in its space. */
  readonly tip: number | Float64Array;
}

/** A foot of one skeleton, from the ankle to the ball, and its toes from there on. */
export interface Foot extends PointedJoints {
  readonly shin: number;
  readonly toes: PointedJoints | undefined;
}

/**
 * The foot at the end of a leg; undefined if nothing tells where it points.
 * @param rest the skeleton in its file pose
 */
export function footOf(
  skeleton: Skeleton,
  space: Space | undefined,
  rest: RetargetBody,
  parts: BodyParts,
  ankle: number,
): Foot | undefined {
  const { joints } = skeleton;
  const ends = joints.flatMap(({ endSites = [] }, joint) => endSites.map((at) => ({ joint, at })));
  const metres = space ? metresPerUnit(space) : 1;
  const tree: PointTree = {
    above: Int32Array.from([...joints.map(({ parent }) => parent), ...ends.map(({ joint }) => joint)]),
    lengthOf: (point) =>
      point < joints.length
        ? distance(rest, point, joints[point].parent)
        : metres * Math.hypot(...ends[point - joints.length].at),
  };
  const pointed = (joint: number, point: number): PointedJoints | undefined => {
    if (point < 0) return undefined;
    const tip = point < joints.length ? point : Float64Array.from(ends[point - joints.length].at);
    return { joints: fromOn(skeleton, joint), tip };
  };
  const foot = pointed(ankle, footTip(tree, parts, ankle));
  if (!foot) return undefined;
  const toes = typeof foot.tip === 'number' ? pointed(foot.tip, tipBelow(tree, foot.tip)) : undefined;
  return { ...foot, shin: joints[ankle].parent, toes };
}

/** A joint and all below it. */
function fromOn({ joints }: Skeleton, joint: number): number[] {
  const out = new Set([joint]);
  for (let j = joint + 1; j < joints.length; j++) if (out.has(joints[j].parent)) out.add(j);
  return [...out];
}

/** Unit vector from the joint to its tip. */
export function footDirection(body: RetargetBody, foot: PointedJoints): Float64Array {
  const way = wayToTip(body, foot);
  const length = Math.hypot(...way);
  return length > 0 ? way.map((v) => v / length) : way;
}

function footLength(body: RetargetBody, foot: PointedJoints): number {
  return Math.hypot(...wayToTip(body, foot));
}

function wayToTip({ points, rotations }: RetargetBody, { joints: [joint], tip }: PointedJoints): Float64Array {
  const out = new Float64Array(3);
  if (typeof tip === 'number') for (let k = 0; k < 3; k++) out[k] = points[3 * tip + k] - points[3 * joint + k];
  else turnVector(rotations, 9 * joint, tip, 0, out, 0);
  return out;
}

/** Radians above the horizontal, of a unit vector. */
export function pitchOf(direction: Float64Array): number {
  return Math.asin(Math.min(1, Math.max(-1, direction[1])));
}

const DEGREE = Math.PI / 180;
/** Slopes of bones from ankle to ball that flat soles may have; others are those of poses that stand on nothing. */
const FLATTEST = -5 * DEGREE;
const STEEPEST = -60 * DEGREE;

/** Whether a standing character's foot can be believed to be flat. */
export function looksFlat(body: RetargetBody, foot: Foot): boolean {
  const pitch = pitchOf(footDirection(body, foot));
  return pitch < FLATTEST && pitch > STEEPEST;
}

/** Most frames of a take in which a foot counts as flat, as a fraction: those with the lowest ankle, on a steep shin. */
const FLAT = 0.06;
/** How much higher it may be than in the lowest; of the length from ankle to tip. */
const AS_LOW = 0.15;
/** Cosine: 45°. */
const STEEP = Math.SQRT1_2;
/** Usual slopes of flat feet: from an ankle 9 cm high to the ball, and from there to the end of the toes. */
const USUAL = -26 * DEGREE;
const USUAL_TOES = -6 * DEGREE;

/**
 * The body with feet as flat as they are, on average, where they are lowest in these bodies; undefined if a shin is
 * never steep. On tiptoe, ankles are high. Both feet get the same slopes, those of the one that is nearer to what is
 * usual, since the other may be on its toes all the time.
 */
export function withFlatFeet(
  body: RetargetBody,
  all: readonly RetargetBody[],
  feet: readonly Foot[],
): RetargetBody | undefined {
  const out = { points: body.points.slice(), rotations: body.rotations.slice() };
  const flat = feet.map((foot) => lowest(all, foot));
  if (flat.some((bodies) => bodies.length === 0)) return undefined;
  flatten(out, feet, flat, USUAL);
  const withToes = feet.flatMap(({ toes }, i) => (toes ? [{ toes, flat: flat[i] }] : []));
  flatten(
    out,
    withToes.map(({ toes }) => toes),
    withToes.map((foot) => foot.flat),
    USUAL_TOES,
  );
  return out;
}

/** Turns feet, or their toes, so that what is their lower side in these bodies is down, and slopes alike. */
function flatten(
  out: RetargetBody,
  feet: readonly PointedJoints[],
  flat: readonly (readonly RetargetBody[])[],
  usual: number,
): void {
  const pitches = feet.map((foot, i) => {
    turnDown(out, foot.joints, flat[i]);
    return pitchOf(footDirection(out, foot));
  });
  const pitch = pitches.reduce((a, b) => (Math.abs(b - usual) < Math.abs(a - usual) ? b : a), Infinity);
  feet.forEach((foot, i) => {
    raise(out, foot, pitch - pitches[i]);
  });
}

function lowest(all: readonly RetargetBody[], foot: Foot): readonly RetargetBody[] {
  const { shin, joints } = foot;
  const [ankle] = joints;
  const height = ({ points }: RetargetBody) => points[3 * ankle + 1];
  const steep = all.filter(({ points }) => {
    const d = [0, 1, 2].map((k) => points[3 * shin + k] - points[3 * ankle + k]);
    return d[1] > STEEP * Math.hypot(...d);
  });
  const sorted = steep.sort((a, b) => height(a) - height(b));
  const most = sorted.length > 0 ? height(sorted[0]) + AS_LOW * footLength(sorted[0], foot) : 0;
  return sorted.filter((each, i) => i < Math.max(1, FLAT * all.length) && height(each) <= most);
}

const DOWN = Float64Array.of(0, -1, 0);

/** Turns joints, about the first of them, so that what is its lower side in these bodies is down. */
function turnDown(body: RetargetBody, joints: readonly number[], flat: readonly RetargetBody[]): void {
  const [first] = joints;
  const down = new Float64Array(3);
  for (const { rotations } of flat) {
    for (let k = 0; k < 3; k++) down[k] -= rotations[9 * first + 3 * k + 1];
  }
  turnVector(body.rotations, 9 * first, down, 0, down, 0);
  const turn = new Float64Array(9);
  swing(down, 0, DOWN, 0, turn, 0);
  turnJoints(body, joints, turn);
}

/** Raises a tip by an angle. */
function raise(body: RetargetBody, foot: PointedJoints, angle: number): void {
  const axis = raisingAxis(footDirection(body, foot));
  if (!axis) return;
  const turn = new Float64Array(9);
  turnAbout(axis[0], 0, axis[2], Math.cos(angle), Math.sin(angle), turn, 0);
  turnJoints(body, foot.joints, turn);
}

/** The horizontal unit vector about which a direction is raised; undefined if it points straight up or down. */
export function raisingAxis([x, , z]: Float64Array): Float64Array | undefined {
  const across = Math.hypot(x, z);
  return across > 1e-6 ? Float64Array.of(-z / across, 0, x / across) : undefined;
}

/** Turns joints about the first one's place. */
function turnJoints({ points, rotations }: RetargetBody, joints: readonly number[], turn: Float64Array): void {
  const turned = new Float64Array(9);
  const [x, y, z] = points.subarray(3 * joints[0], 3 * joints[0] + 3);
  for (const j of joints) {
    multiply3(turn, 0, rotations, 9 * j, turned, 0);
    copy3(turned, 0, rotations, 9 * j);
    const p = Float64Array.of(points[3 * j] - x, points[3 * j + 1] - y, points[3 * j + 2] - z);
    turnVector(turn, 0, p, 0, p, 0);
    points.set([p[0] + x, p[1] + y, p[2] + z], 3 * j);
  }
}
