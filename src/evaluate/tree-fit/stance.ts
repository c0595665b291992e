/**
 * People at rest: the directions of their bones upright with arms stretched out, a T-pose, from which programs that
 * open the take tell how it turns them.
 */
import { setIdentity3, swing, turnVector } from '../../math/mat3.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { nearestRotation } from './nearest-rotation.ts';
import type { JointFrameSet } from './point-paths.ts';
import { addProduct } from './rest-shape.ts';

/** From its parent to a joint, without its side: to the left, up, and forward; to the right it is mirrored. */
const DIRECTIONS: Readonly<Record<string, Vec3>> = {
  ...{ hip: [1, 0, 0], knee: [0, -1, 0], ankle: [0, -1, 0], foot: [0, -0.4, 1], foot_index: [0, -0.4, 1] },
  ...{ big_toe: [-0.2, -0.4, 1], small_toe: [0.4, -0.4, 1], heel: [0, -0.7, -0.7] },
  ...{ spine: [0, 1, 0], spine1: [0, 1, 0], spine2: [0, 1, 0], spine3: [0, 1, 0], chest: [0, 1, 0], thorax: [0, 1, 0] },
  ...{
    neck: [0, 1, 0],
    head: [0, 1, 0],
    collar: [0.8, 0.6, 0],
    shoulder: [1, 0, 0],
    elbow: [1, 0, 0],
    wrist: [1, 0, 0],
  },
  ...{ hand: [1, 0, 0], hand_tip: [1, 0, 0], thumb: [0.7, 0, 0.7], index: [1, 0, 0.2], pinky: [1, 0, -0.3] },
  ...{ nose: [0, 0.8, 0.6], eye: [0.5, 0.7, -0.5], eye_inner: [-1, 0, 0], eye_outer: [1, 0, 0] },
  ...{ ear: [0.5, 0, -0.9], mouth: [0.4, -0.8, -0.5] },
};

/** The direction of a joint from its parent in the space of the body: left, up, forward. Undefined of other names. */
function directionOf(name: string): Vec3 | undefined {
  const side = /left|right/.exec(name)?.[0];
  const found = DIRECTIONS[name.replace(/^(left|right)_|_(left|right)$/, '')];
  return found && side === 'right' ? [-found[0], found[1], found[2]] : found;
}

/** The axis along which a body is upright, and whether up is its positive end. */
export interface BodyUp {
  readonly axis: 0 | 1 | 2;
  readonly sign: 1 | -1;
}

/**
 * Turns bones into a T-pose: upright along the axis along which the body is upright in most frames, which is returned.
 * Those that start at one joint turn as one.
 * @param offsets x y z of each joint from its parent; changed in place, unless a name is unknown
 */
export function toStance(
  names: readonly string[],
  children: readonly (readonly number[])[],
  frames: JointFrameSet,
  offsets: Float64Array,
): BodyUp {
  const directions = names.map(directionOf);
  const up = upOf(names, children, frames);
  if (!children.flat().every((child) => directions[child])) return up;
  const axes = bodyAxes(up);
  const wanted = new Float64Array(3);
  const products = new Float64Array(9);
  const turn = new Float64Array(9);
  for (const own of children) {
    products.fill(0);
    for (const child of own) {
      turnVector(axes, 0, Float64Array.from(directions[child] ?? []), 0, wanted, 0);
      addProduct(wanted, 0, offsets, 3 * child, products);
    }
    if (own.length === 1) swing(offsets, 3 * own[0], wanted, 0, turn, 0);
    else {
      setIdentity3(turn);
      nearestRotation(products, turn, IDENTITY);
    }
    for (const child of own) turnVector(turn, 0, offsets, 3 * child, offsets, 3 * child);
  }
  return up;
}

/** Frames in which the body is looked at. */
const MAX_FRAMES = 256;

function upOf(names: readonly string[], children: readonly (readonly number[])[], frames: JointFrameSet): BodyUp {
  const up = new Float64Array(3);
  const { positions } = frames;
  const count = Math.min(frames.count, MAX_FRAMES);
  children.forEach((own, joint) => {
    for (const child of own) {
      const along = directionOf(names[child])?.[1] ?? 0;
      for (let i = 0; i < count; i++) {
        const at = 3 * names.length * Math.floor((i * frames.count) / count);
        for (let k = 0; k < 3; k++) up[k] += along * (positions[at + 3 * child + k] - positions[at + 3 * joint + k]);
      }
    }
  });
  const sizes = up.map(Math.abs);
  const axis = sizes[1] >= sizes[0] && sizes[1] >= sizes[2] ? 1 : sizes[2] >= sizes[0] ? 2 : 0;
  return { axis, sign: up[axis] < 0 ? -1 : 1 };
}

/** Left, up and forward as columns: along the axes of the file. */
function bodyAxes({ axis: along, sign }: BodyUp): Float64Array {
  const left = along === 0 ? 1 : 0;
  const axes = new Float64Array(9);
  axes[left] = 1;
  axes[3 + along] = sign;
  // Left × up.
  axes[6 + 3 - left - along] = sign * ((along - left + 3) % 3 === 1 ? 1 : -1);
  return axes;
}

const IDENTITY = Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1);
