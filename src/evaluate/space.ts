/**
 * From a character's own space to the scene's: metres, y up, feet on the ground y = 0.
 *
 *     M = T(0, lift, 0) · S(metres per unit) · Up            Up: y stays; z up → y up is (x, y, z) → (x, z, −y)
 *
 * Files of motion capture say neither their unit nor their up axis, nor where the ground is: `guessSpace` looks at how
 * the figure stands and how tall it is.
 */
import type { Vec3 } from '../math/vec3.ts';
import type { ChannelClip } from '../model/clip.ts';
import { DEFAULT_SPACE, type Space } from '../model/document.ts';
import type { CapturedFigure } from '../model/files.ts';
import type { Skeleton } from '../model/skeleton.ts';
import { forFrames } from './figure-frames.ts';
import { compileSkeleton, worldMatrices } from './kinematics.ts';
import { METRES, metresPerUnit } from './metres.ts';

/** The axis that points up in the character's own space: 1 for y, 2 for z. */
export function upAxis(space: Space = DEFAULT_SPACE): 1 | 2 {
  return space.up === 'z' ? 2 : 1;
}

/** Writes where a point of the character's own space is in metres with y up, before any placement. */
export function applySpace(space: Space | undefined, x: number, y: number, z: number, out: Float64Array): void {
  const { up, lift } = space ?? DEFAULT_SPACE;
  const m = space ? metresPerUnit(space) : 1;
  out[0] = m * x;
  out[1] = m * (up === 'z' ? z : y) + lift;
  out[2] = m * (up === 'z' ? -y : z);
}

/** What a person is taken to measure, metres; the units that come nearest to it are how tall figures are guessed. */
const PERSON = 1.7;
/** A figure that no unit brings within this factor of a person's height is scaled to that height. */
const MAX_DEVIATION = 2;
/** In which to find the unit; ordered by how common they are, for ties. */
const GUESSED_UNITS = ['centimetres', 'metres', 'inches', 'millimetres', 'cmu', 'decimetres'] as const;
/** Frames that are looked at, evenly over the clip. */
const MAX_FRAMES = 64;
/** Of the frames' heights: who stands in any of ten frames is measured standing. */
const STANDING = 0.9;
/** Of the frames' lowest points: noise and a toe through the floor are below, jumps above. */
const ON_GROUND = 0.15;
/** A ground that is off by less than this part of the height is believed. */
const BELIEVED = 0.006;

/**
 * Up axis, unit and lift of a figure that does not say.
 *
 * - Up, by names where there are some: from the feet (or else the hips) to the head, over all frames looked at. Without
 *   names: the axis along which the figure extends more, frame by frame. The rest pose is no witness where there is a
 *   clip: in real files (LAFAN1) its bones lie along x.
 * - Unit: the one in which the figure is nearest to 1.7 m, as a ratio. Where none comes within a factor of 2 the figure
 *   is made 1.7 m tall (`own`): what it is, nobody can tell, but it can be seen beside others.
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

/** Of figures that are in one file together, and so in one space: that of the tallest. */
export function guessSharedSpace(figures: readonly CapturedFigure[]): Space {
  const heights = figures.map(({ skeleton, clip }) => {
    const frames = framesOf(skeleton, clip);
    return heightOf(frames, clip !== undefined, upOf(skeleton, frames) === 'z' ? 2 : 1);
  });
  const tallest = figures[heights.indexOf(Math.max(...heights))] ?? figures[0];
  return tallest ? guessSpace(tallest.skeleton, tallest.clip) : DEFAULT_SPACE;
}

/** The unit in which a figure is as tall as a person, whatever it is. */
export function metresForPerson(skeleton: Skeleton, clip: ChannelClip | undefined, up: Space['up']): number {
  const height = heightOf(framesOf(skeleton, clip), clip !== undefined, up === 'z' ? 2 : 1);
  return height > 0 && Number.isFinite(height) ? Number((PERSON / height).toPrecision(3)) : 1;
}

/** The lift that puts a figure on the ground in a space whose up axis and unit are known. */
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
  // A lone rest pose may lie on its side.
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

/** One frame's figure, in the character's own space: the box around it, and from its feet to its head. */
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
    // Most files are y up: a figure as deep as it is tall is.
    return z > 1.2 * y ? 'z' : 'y';
  }
  return Math.abs(z) > Math.abs(y) ? 'z' : 'y';
}

/** Of finite numbers; NaN of none. */
function percentile(values: readonly number[], part: number): number {
  const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
  return sorted[Math.round(part * (sorted.length - 1))] ?? Number.NaN;
}
