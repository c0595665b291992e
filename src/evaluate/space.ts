/**
 * From a character's own space to the scene's: metres, y up, feet on the ground y = 0.
 *
 *     M = T(0, lift, 0) · S(metres per unit) · Up            Up: identity for y; for z (x, y, z) → (x, z, −y)
 *
 * Motion capture files state neither unit, up axis nor ground level: `guessSpace` estimates them from the figure's
 * posture and height.
 */
import type { Vec3 } from '../math/vec3.ts';
import type { ChannelClip } from '../model/clip.ts';
import { DEFAULT_SPACE, type Space } from '../model/document.ts';
import type { CapturedFigure } from '../model/files.ts';
import type { Skeleton } from '../model/skeleton.ts';
import { forFrames } from './figure-frames.ts';
import { compileSkeleton, worldMatrices } from './kinematics.ts';
import { METRES, metresPerUnit } from './metres.ts';

/** The up axis in the character's own space: 1 for y, 2 for z. */
export function upAxis(space: Space = DEFAULT_SPACE): 1 | 2 {
  return space.up === 'z' ? 2 : 1;
}

/** Writes a point of the character's own space in metres with y up, before any placement. */
export function applySpace(space: Space | undefined, x: number, y: number, z: number, out: Float64Array): void {
  const { up, lift } = space ?? DEFAULT_SPACE;
  const m = space ? metresPerUnit(space) : 1;
  out[0] = m * x;
  out[1] = m * (up === 'z' ? z : y) + lift;
  out[2] = m * (up === 'z' ? -y : z);
}

/** Assumed height of a person, metres; figures get the unit that brings them closest. */
const PERSON = 1.7;
/** A figure that no unit brings within this factor of a person's height is scaled to that height. */
const MAX_DEVIATION = 2;
/** Candidate units, most common first, for ties. */
const GUESSED_UNITS = ['centimetres', 'metres', 'inches', 'millimetres', 'cmu', 'decimetres'] as const;
/** Frames examined, evenly over the clip. */
const MAX_FRAMES = 64;
/** Percentile of the frames' heights: a figure that stands in one of ten frames is measured standing. */
const STANDING = 0.9;
/** Percentile of the frames' lowest points: noise and toes through the floor are below, jumps above. */
const ON_GROUND = 0.15;
/** A ground level off by less than this fraction of the height is kept. */
const BELIEVED = 0.006;

/**
 * Guesses up axis, unit and lift of a figure.
 *
 * - Up, by names if possible: from the feet (or else the hips) to the head, over all examined frames. Without names:
 *   the axis along which the figure extends most, frame by frame. The rest pose is not used if there is a clip: in real
 *   files (LAFAN1) its bones lie along x.
 * - Unit: the one that brings the figure closest to 1.7 m, as a ratio. If none is within a factor of 2, the figure is
 *   made 1.7 m tall (`own`): its true size is unknown, but it can be seen beside others.
 * - Lift: puts the lowest joint or End Site on the ground, at the 15th percentile of the frames.
 */
export function guessSpace(skeleton: Skeleton, clip: ChannelClip | undefined): Space {
  const frames = framesOf(skeleton, clip);
  const up = upOf(skeleton, frames);
  const axis = up === 'z' ? 2 : 1;
  const lows = frames.map(({ min }) => min[axis]);
  const height = heightOf(frames, clip !== undefined, axis);
  if (!(height > 0) || !Number.isFinite(height)) return { ...DEFAULT_SPACE, up };
  const sized = unitFor(height);
  const metres = metresPerUnit({ ...sized, up, lift: 0 });
  const low = metres * percentile(lows, ON_GROUND);
  const lift = Math.abs(low) < BELIEVED * metres * height ? 0 : -Number(low.toFixed(3));
  return { up, ...sized, lift: lift || 0 };
}

/** For figures in one file, which share a space: that of the tallest. */
export function guessSharedSpace(figures: readonly CapturedFigure[]): Space {
  const heights = figures.map(({ skeleton, clip }) => {
    const frames = framesOf(skeleton, clip);
    return heightOf(frames, clip !== undefined, upOf(skeleton, frames) === 'z' ? 2 : 1);
  });
  const tallest = figures[heights.indexOf(Math.max(...heights))] ?? figures[0];
  return tallest ? guessSpace(tallest.skeleton, tallest.clip) : DEFAULT_SPACE;
}

/** Metres per unit that make a figure as tall as a person. */
export function metresForPerson(skeleton: Skeleton, clip: ChannelClip | undefined, up: Space['up']): number {
  const height = heightOf(framesOf(skeleton, clip), clip !== undefined, up === 'z' ? 2 : 1);
  return height > 0 && Number.isFinite(height) ? Number((PERSON / height).toPrecision(3)) : 1;
}

/** The lift that puts a figure on the ground in a space with known up axis and unit. */
export function liftOntoGround(skeleton: Skeleton, clip: ChannelClip | undefined, space: Space): number {
  const axis = upAxis(space);
  const lows = framesOf(skeleton, clip).map(({ min }) => min[axis]);
  const low = metresPerUnit(space) * percentile(lows, ON_GROUND);
  return Number.isFinite(low) ? -Number(low.toPrecision(4)) || 0 : 0;
}

function heightOf(frames: readonly FrameShape[], moving: boolean, axis: 1 | 2): number {
  const extent = ({ min, max }: FrameShape, k: number) => max[k] - min[k];
  if (moving) {
    const heights = frames.map((frame) => extent(frame, axis));
    return percentile(heights, STANDING);
  }
  // A rest pose without a clip may lie on its side.
  return Math.max(...[0, 1, 2].map((k) => extent(frames[0], k)));
}

function unitFor(height: number): Pick<Space, 'unit' | 'metres'> {
  let best: (typeof GUESSED_UNITS)[number] = GUESSED_UNITS[0];
  let least = Infinity;
  for (const unit of GUESSED_UNITS) {
    const off = Math.abs(Math.log((METRES[unit] * height) / PERSON));
    if (off >= least) continue;
    least = off;
    best = unit;
  }
  if (least <= Math.log(MAX_DEVIATION)) return { unit: best };
  return { unit: 'own', metres: Number((PERSON / height).toPrecision(3)) };
}

/** A figure in one frame, in the character's own space: its bounding box, and the vector from feet to head. */
interface FrameShape {
  readonly min: readonly number[];
  readonly max: readonly number[];
  readonly toHead: Vec3 | undefined;
}

function framesOf(skeleton: Skeleton, clip: ChannelClip | undefined): FrameShape[] {
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  const head = skeleton.joints.findIndex(({ name }) => HEAD.test(name));
  const feet = indicesOf(skeleton, FOOT);
  const low = feet.length ? feet : indicesOf(skeleton, HIPS).slice(0, 1);
  const shapes: FrameShape[] = [];
  forFrames(skeleton, clip, MAX_FRAMES, (dofs) => {
    worldMatrices(compiled, dofs, world);
    shapes.push(shapeOf(skeleton, world, head, low));
  });
  return shapes;
}

const HEAD = /head/i;
const FOOT = /foot|ankle|toe/i;
const HIPS = /hip|pelvis/i;

function indicesOf({ joints }: Skeleton, pattern: RegExp): number[] {
  return joints.flatMap(({ name }, j) => (pattern.test(name) ? [j] : []));
}

function shapeOf(skeleton: Skeleton, world: Float64Array, head: number, low: readonly number[]): FrameShape {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  skeleton.joints.forEach(({ endSites }, j) => {
    const o = 16 * j;
    for (let k = 0; k < 3; k++) {
      min[k] = Math.min(min[k], world[o + 12 + k]);
      max[k] = Math.max(max[k], world[o + 12 + k]);
      for (const [x, y, z] of endSites ?? NO_POINTS) {
        const at = world[o + k] * x + world[o + 4 + k] * y + world[o + 8 + k] * z + world[o + 12 + k];
        min[k] = Math.min(min[k], at);
        max[k] = Math.max(max[k], at);
      }
    }
  });
  if (head < 0 || low.length === 0) return { min, max, toHead: undefined };
  const along = (k: number) =>
    world[16 * head + 12 + k] - low.reduce((sum, j) => sum + world[16 * j + 12 + k], 0) / low.length;
  return { min, max, toHead: [along(0), along(1), along(2)] };
}

const NO_POINTS: readonly Vec3[] = [];

function upOf(skeleton: Skeleton, frames: readonly FrameShape[]): 'y' | 'z' {
  let y = 0;
  let z = 0;
  for (const { toHead } of frames) {
    y += toHead?.[1] ?? 0;
    z += toHead?.[2] ?? 0;
  }
  if (y === 0 && z === 0 && skeleton.joints.length > 0) {
    for (const { min, max } of frames) {
      y += max[1] - min[1];
      z += max[2] - min[2];
    }
    // Most files are y up, so z must be clearly larger.
    return z > 1.2 * y ? 'z' : 'y';
  }
  return Math.abs(z) > Math.abs(y) ? 'z' : 'y';
}

/** Of the finite numbers; NaN if there are none. */
function percentile(values: readonly number[], part: number): number {
  const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
  return sorted[Math.round(part * (sorted.length - 1))] ?? Number.NaN;
}
