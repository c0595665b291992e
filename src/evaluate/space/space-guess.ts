/**
 * Motion capture files state neither unit, up axis nor ground level: they are guessed here, from the skeleton's
 * proportions, the shape of its file pose, and statistics over the take, which may be one of lying or crawling.
 */

import type { Capture } from '../../model/files.ts';
import { perSkeleton } from '../../model/skeleton/per-skeleton.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { DEFAULT_SPACE, type FileSpace, type Space } from '../../model/space.ts';
import type { Take } from '../../model/takes/take.ts';
import { LIMB_SIDES, partsOf } from '../retarget/roles.ts';
import { type FrameShape, frameShapes, percentile } from './frame-shapes.ts';
import { METRES, metresPerUnit } from './metres.ts';
import { GROUND_PERCENTILE, lowest, upAxis } from './space.ts';

/** Assumed height of a person, metres; characters get the unit that brings them closest. */
const PERSON = 1.7;
/** Candidate units, most common first, for ties. */
const GUESSED_UNITS = ['centimetres', 'metres', 'inches', 'millimetres', 'cmu', 'decimetres'] as const;
type GuessedUnit = (typeof GUESSED_UNITS)[number];
/** Units that most files are in. */
export const COMMON_UNITS: ReadonlySet<GuessedUnit> = new Set(['centimetres', 'metres', 'millimetres']);
/**
 * How far from a person's height a unit may leave a character, as a factor: people are children, too, but few are in
 * inches, and characters that aren't recognised as people are animals of any size.
 */
const COMMON_DEVIATION = { person: 2, other: 5 } as const;
const RARE_DEVIATION = { person: 1.3, other: 2 } as const;
/** Percentile of the frames' heights: a character that stands in one of ten frames is measured standing. */
const STANDING = 0.9;
/** A ground level off by less than this fraction of the height is kept. */
const BELIEVED = 0.006;

/**
 * Guesses up axis, unit and lift of a character.
 *
 * - Up: see `upOf`.
 * - Unit: the one that brings the character closest to 1.7 m, as a ratio: the sum of its bones from sole to head, or
 *   the height of its frames if its parts are not recognised; of those too, a common unit that is near before a rare
 *   one that is nearer. If none is near (`COMMON_DEVIATION`), the character is made 1.7 m tall (`own`): its true size is
 *   unknown, but it can be seen beside others.
 * - Lift: puts the lowest joint or End Site on the ground, at the 15th percentile of the frames.
 */
export function guessSpace(skeleton: Skeleton, take: Take | undefined): Space {
  return guessed(skeleton, take).space;
}

/** Characters of one file that are measured: what is cached of each takes a hundred times the bytes of a bare root. */
const MAX_MEASURED = 256;

/**
 * For characters in one file, which share a space: that of the tallest, of the first 256.
 * @param up the axis, if it is known
 */
export function guessSharedSpace(captures: readonly Capture[], up?: Space['up']): FileSpace {
  const all = captures.slice(0, MAX_MEASURED).map(({ skeleton, take }) => guessed(skeleton, take, up));
  const none = { space: DEFAULT_SPACE, standing: 0, height: 0 };
  const { space, standing } = all.reduce((a, b) => (b.height > a.height ? b : a), all[0] ?? none);
  return { space, standing };
}

/**
 * How tall a character is, in its own units, and whether its parts are recognised as those of a person.
 *
 * @param isUpKnown whether one whose trunk lies, in its file pose and in the take, is an animal with a person's names
 */
export function guessedHeight(skeleton: Skeleton, take: Take | undefined, up: Space['up'], isUpKnown = false) {
  const axis = upAxis({ up });
  const named = bodyOf(skeleton);
  const frames = frameShapes(skeleton, take);
  const body = named && isUpKnown && lies(skeleton, named, frames, up) ? undefined : named;
  const height = heightOf(body, frames, take !== undefined, axis);
  return { height, isPerson: body !== undefined };
}

/** Cosine of the slant from which a trunk lies. */
const LYING = 0.7;

function lies(skeleton: Skeleton, { hips, head }: Body, frames: readonly FrameShape[], up: Space['up']): boolean {
  const axis = upAxis({ up });
  const sign = up === '-y' ? -1 : 1;
  const upright = (frame: FrameShape) =>
    (sign * (frame.points[3 * head + axis] - frame.points[3 * hips + axis])) / distance(frame, head, hips);
  return upright(restOf(skeleton)) < LYING && percentile(frames.map(upright), 0.5) < LYING;
}

/** Metres per unit that make a character as tall as a person; parameters as of `guessedHeight`. */
export function metresForPerson(...capture: Parameters<typeof guessedHeight>): number {
  const { height } = guessedHeight(...capture);
  return height > 0 && Number.isFinite(height) ? Number((PERSON / height).toPrecision(3)) : 1;
}

function guessed(
  skeleton: Skeleton,
  take: Take | undefined,
  known?: Space['up'],
): FileSpace & { readonly height: number } {
  const body = bodyOf(skeleton);
  const frames = frameShapes(skeleton, take);
  const { up, standing } = known ? { up: known, standing: 0 } : upOf(skeleton, body, frames, take !== undefined);
  const axis = upAxis({ up });
  const height = heightOf(body, frames, take !== undefined, axis);
  if (!(height > 0) || !Number.isFinite(height))
    return { space: { ...DEFAULT_SPACE, up, known: 'guessed' }, standing: 0, height: 0 };
  const sized = unitFor(height, body !== undefined || isTall(frames, axis));
  const metres = metresPerUnit({ ...sized, up, lift: 0 });
  const lows = frames.map((frame) => lowest(frame, up));
  const low = metres * percentile(lows, GROUND_PERCENTILE);
  const lift = Math.abs(low) < BELIEVED * metres * height ? 0 : -Number(low.toFixed(3));
  return { space: { up, ...sized, lift: lift || 0, known: 'guessed' }, standing, height };
}

/** Joints of a person. */
interface Body {
  readonly hips: number;
  readonly head: number;
  /** Thigh, shin and foot of both legs. */
  readonly legs: readonly (readonly [number, number, number])[];
  /** From the head down to the hips. */
  readonly trunk: readonly number[];
  /** All joints below the feet, and below the head. */
  readonly soles: readonly number[];
  readonly crown: readonly number[];
}

/** By shape, characters are recognised upright. Cached. */
const bodyOf = perSkeleton((skeleton): Body | undefined => bodyIn(skeleton, 'y') ?? bodyIn(skeleton, 'z'));

/** The file pose. Cached. */
const restOf = perSkeleton((skeleton): FrameShape => frameShapes(skeleton, undefined)[0]);

function bodyIn(skeleton: Skeleton, up: Space['up']): Body | undefined {
  const { joints } = skeleton;
  const { single } = partsOf(skeleton, up);
  const [hips, head] = [single.get('hips'), single.get('head')];
  const legs = LIMB_SIDES.flatMap((side) => {
    const [thigh, shin, foot] = (['thigh', 'shin', 'foot'] as const).map((part) => single.get(`${side} ${part}`));
    return thigh === undefined || shin === undefined || foot === undefined ? [] : [[thigh, shin, foot] as const];
  });
  if (hips === undefined || head === undefined || legs.length < 2) return undefined;
  const trunk = [head];
  for (let j = joints[head].parent; j >= 0 && j !== hips; j = joints[j].parent) trunk.push(j);
  const below = (tops: readonly number[]) => {
    const out = new Set(tops);
    joints.forEach(({ parent }, j) => {
      if (out.has(parent)) out.add(j);
    });
    return [...out];
  };
  return {
    hips,
    head,
    legs,
    trunk: [...trunk, hips],
    soles: below(legs.map(([, , foot]) => foot)),
    crown: below([head]),
  };
}

function distance({ points }: FrameShape, a: number, b: number): number {
  const x = points[3 * a] - points[3 * b];
  const y = points[3 * a + 1] - points[3 * b + 1];
  const z = points[3 * a + 2] - points[3 * b + 2];
  return Math.sqrt(x * x + y * y + z * z);
}

/** Thigh and shin, the average of both. */
function legLength(frame: FrameShape, { legs }: Body): number {
  return (
    legs.reduce((sum, [thigh, shin, foot]) => sum + distance(frame, thigh, shin) + distance(frame, shin, foot), 0) /
    legs.length
  );
}

/** Heights of the ankle, and of the head above its joint, as fractions of the leg: their bones are seldom in files. */
const ANKLE = 0.1;
const CROWN = 0.2;

/** Sum of the bones from the sole to the top of the head, whatever the posture. */
function stature(frame: FrameShape, body: Body): number {
  const leg = legLength(frame, body);
  let trunk = 0;
  for (let i = 1; i < body.trunk.length; i++) trunk += distance(frame, body.trunk[i - 1], body.trunk[i]);
  return leg * (1 + ANKLE + CROWN) + trunk;
}

function heightOf(body: Body | undefined, frames: readonly FrameShape[], moving: boolean, axis: 1 | 2): number {
  if (body)
    return percentile(
      frames.map((frame) => stature(frame, body)),
      0.5,
    );
  const extent = ({ min, max }: FrameShape, k: number) => max[k] - min[k];
  if (moving)
    return percentile(
      frames.map((frame) => extent(frame, axis)),
      STANDING,
    );
  // A rest pose without a take may lie on its side.
  return Math.max(...[0, 1, 2].map((k) => extent(frames[0], k)));
}

/** Part of its width that the height of one must be who may be a person with arms held out. */
const TALL = 0.8;

/** Whether a character is usually taller than it is long: animals seldom are. */
function isTall(frames: readonly FrameShape[], axis: 1 | 2): boolean {
  const ratios = frames.map(({ min, max }) => {
    const [x, y, z] = [0, 1, 2].map((k) => max[k] - min[k]);
    return axis === 2 ? z / Math.max(x, y) : y / Math.max(x, z);
  });
  return !(percentile(ratios, 0.5) < TALL);
}

function unitFor(height: number, isPerson: boolean): Pick<Space, 'unit' | 'metres'> {
  const who = isPerson ? 'person' : 'other';
  const units = unitsByHeight(height);
  const near = units.filter(
    ({ unit, off }) => off <= Math.log((COMMON_UNITS.has(unit) ? COMMON_DEVIATION : RARE_DEVIATION)[who]),
  );
  const best = isPerson ? near[0] : (near.find(({ unit }) => COMMON_UNITS.has(unit)) ?? near[0]);
  return best ? { unit: best.unit } : { unit: 'own', metres: Number((PERSON / height).toPrecision(3)) };
}

/** Units by how near to a person's height they bring a character, the nearest first; `off`: logarithm of the factor. */
export function unitsByHeight(height: number): readonly { readonly unit: GuessedUnit; readonly off: number }[] {
  const units = GUESSED_UNITS.map((unit) => ({ unit, off: Math.abs(Math.log((METRES[unit] * height) / PERSON)) }));
  return units.sort((a, b) => a.off - b.off);
}

/** Cosine of the largest slant of one who stands: 37°. */
const ALONG = 0.8;
/** Fraction of a leg's length: one who stands has nearly straight legs. */
const STRETCHED = 0.85;
/** Fraction of the frames in which a character stands that make it a take with standing. */
const OFTEN = 0.1;
/** How much better the ground along an axis must be than along y, or than along the file pose's axis. */
const CLEARLY = 0.05;

/**
 * The up axis.
 *
 * - Along which axis does the character stand: legs stretched, trunk in line with them, head up? In its file pose, and
 *   in each frame of the take.
 * - Along which axis is there a ground: the character's lowest point is always at one level, near 0?
 *
 * The axis along which the file pose stands is believed, unless the take stands along the other one, and on a better
 * ground: one who lies does so too, but on a worse ground. Without a standing file pose (in LAFAN1 its bones lie along
 * x) the ground decides between axes along which the take stands, or between both. Most files are y up. Animals stand
 * on their legs in their file pose, whatever their trunk does.
 *
 * Of characters whose parts are not recognised, up is the axis along which nearly all is above the feet: along the
 * others there is a tail behind them, and a head in front. Without two feet up is from the one or the hips to the head,
 * by their names, and without names the axis along which the character extends most, frame by frame.
 */
function upOf(skeleton: Skeleton, body: Body | undefined, frames: readonly FrameShape[], moving: boolean) {
  if (!body) return { up: upByNames(skeleton, frames), standing: 0 };
  const share = (axis: 1 | 2) => frames.filter((frame) => stands(frame, body, axis)).length / frames.length;
  const [y, z] = [share(1), share(2)];
  const size = percentile(
    frames.map((frame) => stature(frame, body)),
    0.5,
  );
  const [ground, groundZ] = ([1, 2] as const).map((axis) => unevenness(frames, axis, size));
  const rest = restOf(skeleton);
  const restZ = stands(rest, body, 2) || (onLegs(rest, body, 2) && !onLegs(rest, body, 1));
  const found = (up: Space['up']) => ({ up, standing: up === 'z' ? z : y });
  if (!moving) return found(restZ ? 'z' : 'y');
  if (restZ || stands(rest, body, 1) || onLegs(rest, body, 1)) {
    const [own, other] = restZ ? [z, y] : [y, z];
    const [ownGround, otherGround] = restZ ? [groundZ, ground] : [ground, groundZ];
    const isOther = own < OFTEN && other >= OFTEN && otherGround + CLEARLY < ownGround;
    return found(isOther === restZ ? 'y' : 'z');
  }
  const mayBeZ = z >= OFTEN || y < OFTEN;
  return found(mayBeZ && groundZ + CLEARLY < ground ? 'z' : 'y');
}

/** Component along the axis of the direction from one joint to another. */
function along(frame: FrameShape, axis: 1 | 2, a: number, b: number): number {
  return (frame.points[3 * b + axis] - frame.points[3 * a + axis]) / (distance(frame, a, b) || 1);
}

function stands(frame: FrameShape, body: Body, axis: 1 | 2): boolean {
  const { hips, head, legs } = body;
  return (
    along(frame, axis, hips, head) > ALONG &&
    onLegs(frame, body, axis) &&
    legs.every(
      ([thigh, shin, foot]) =>
        distance(frame, foot, thigh) > STRETCHED * (distance(frame, thigh, shin) + distance(frame, shin, foot)),
    )
  );
}

function onLegs(frame: FrameShape, { legs }: Body, axis: 1 | 2): boolean {
  return legs.every(([thigh, , foot]) => along(frame, axis, foot, thigh) > ALONG);
}

/** How little an axis has a ground: distance of the usual lowest point from 0, and its variation; in character heights. */
function unevenness(frames: readonly FrameShape[], axis: 1 | 2, size: number): number {
  const lows = frames.map(({ min }) => min[axis]);
  const [low, high] = [percentile(lows, 0.15), percentile(lows, 0.85)];
  return Math.min(1, Math.abs(low) / size) + 2 * Math.min(1, (high - low) / size);
}

const HEAD = /head/i;
const FOOT = /foot|feet|ankle|toe|paw|hoof/i;
const HIPS = /hip|pelvis/i;
/** How much more of a character must be above its feet along z than along y, of all of it. */
const MORE = 0.1;

function upByNames({ joints }: Skeleton, frames: readonly FrameShape[]): Space['up'] {
  const named = (pattern: RegExp) => joints.flatMap(({ name }, j) => (pattern.test(name) ? [j] : []));
  const feet = named(FOOT);
  if (feet.length > 1) {
    const own = new Set(feet);
    const others = joints.flatMap((_, j) => (own.has(j) ? [] : [j]));
    const [y, z] = ([1, 2] as const).map((axis) => partAbove(frames, feet, others, axis));
    return z > y + MORE ? 'z' : 'y';
  }
  const [head] = named(HEAD);
  const [low] = [...feet, ...named(HIPS)];
  let y = 0;
  let z = 0;
  for (const { points } of head !== undefined && low !== undefined ? frames : []) {
    y += points[3 * head + 1] - points[3 * low + 1];
    z += points[3 * head + 2] - points[3 * low + 2];
  }
  if (y !== 0 || z !== 0) return Math.abs(z) > Math.abs(y) ? 'z' : 'y';
  for (const { min, max } of joints.length > 0 ? frames : []) {
    y += max[1] - min[1];
    z += max[2] - min[2];
  }
  // Most files are y up, so z must be clearly larger.
  return z > 1.2 * y ? 'z' : 'y';
}

/** Part of these joints, over all frames, that are above the middle of the feet along an axis. */
function partAbove(frames: readonly FrameShape[], feet: readonly number[], others: readonly number[], axis: 1 | 2) {
  let above = 0;
  for (const { points } of frames) {
    const level = feet.reduce((sum, j) => sum + points[3 * j + axis], 0) / feet.length;
    for (const j of others) if (points[3 * j + axis] > level) above++;
  }
  return above / Math.max(1, frames.length * others.length);
}
