/**
 * A character's reach, and the balls that pins can't leave: centred on the first movable joint on the path, with the
 * total length of the bones from there to the pin as radius. Targets outside are moved onto the ball before solving: an
 * irreducible error would keep the damping high, and the pose would creep towards its optimum forever.
 */
import { length3, type Vec3 } from '../../math/vec3.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { CompiledSkeleton } from '../kinematics.ts';
import type { IkPin } from './pins.ts';
import type { Balls, PinArrays, Slots } from './state.ts';
import { writeTwists } from './twists.ts';

/** Smaller than this is not divided by. */
const NOTHING = 1e-100;

/** The longest path along the bones from the root's pivot to any end of a joint or a pin; 1 if there is none. */
export function pathReach(
  { joints }: Skeleton,
  { parent }: CompiledSkeleton,
  pins: readonly IkPin[],
  world: Float64Array,
): number {
  const ways = new Float64Array(joints.length);
  let longest = 0;
  const goOn = (j: number, point: Vec3) => {
    const end = ways[j] + distance(world, 16 * j, point);
    if (end > longest && end < Infinity) longest = end;
  };
  joints.forEach(({ length = 0, endSites = [] }, j) => {
    const above = parent[j];
    if (above >= 0) ways[j] = ways[above] + pivotDistance(world, 16 * j, world, 16 * above);
    goOn(j, [0, length, 0]);
    for (const end of endSites) goOn(j, end);
  });
  for (const { joint, point } of pins) goOn(joint, point);
  return longest > NOTHING ? longest : 1;
}

/**
 * The balls that bound the pins.
 * @param dofs the pose in which lengths are measured: a pin has a ball only if they are the same in any pose
 * @param rootMoves whether root translation is a variable: then nothing is bounded
 */
export function ballsOf(
  compiled: CompiledSkeleton,
  slots: Slots,
  pins: PinArrays,
  dofs: Float64Array,
  world: Float64Array,
  rootMoves: boolean,
): Balls {
  const centre = new Int32Array(pins.count).fill(-1);
  const radius = new Float64Array(pins.count).fill(Infinity);
  const { joint, parent, firstPart, isRigid } = slots;
  for (let p = 0; p < pins.count; p++) {
    let s = pins.slot[p];
    let isBounded = !rootMoves && isRigid[s] === 1;
    const [x, y, z] = pins.points.subarray(3 * p, 3 * p + 3);
    let way = distance(world, 16 * joint[s], [x, y, z]);
    let below = -1;
    for (; isBounded && s >= 0; s = parent[s]) {
      if (firstPart[s + 1] > firstPart[s]) {
        isBounded = turnsInPlace(compiled, slots, s, dofs);
        // Joints that only twist the next bone leave its end in place.
        if (below < 0 || centre[p] < 0 || !twists(compiled, slots, s, below, dofs, world)) {
          centre[p] = s;
          radius[p] = way;
        }
      }
      if (parent[s] >= 0) way += pivotDistance(world, 16 * joint[s], world, 16 * joint[parent[s]]);
      below = s;
    }
    if (!isBounded) centre[p] = -1;
  }
  return { centre, radius };
}

/** Whether none of the joint's variables moves its pivot. */
function turnsInPlace(compiled: CompiledSkeleton, slots: Slots, s: number, dofs: Float64Array): boolean {
  const twists = twistsAt(compiled, slots.joint[s], dofs);
  for (let part = slots.firstPart[s]; part < slots.firstPart[s + 1]; part++) {
    const at = 6 * slots.partDof[part];
    if (twists[at + 3] !== 0 || twists[at + 4] !== 0 || twists[at + 5] !== 0) return false;
  }
  return true;
}

/** Whether a joint only rotates about one axis, on which the next joint's pivot lies. */
function twists(
  compiled: CompiledSkeleton,
  slots: Slots,
  s: number,
  next: number,
  dofs: Float64Array,
  world: Float64Array,
): boolean {
  if (slots.firstPart[s + 1] - slots.firstPart[s] !== 1) return false;
  const j = slots.joint[s];
  const twist = twistsAt(compiled, j, dofs).subarray(6 * slots.partDof[slots.firstPart[s]]);
  const [a, b] = [16 * j + 12, 16 * slots.joint[next] + 12];
  const above = compiled.parent[j];
  const axis = [0, 1, 2].map((k) =>
    above < 0 ? twist[k] : [0, 1, 2].reduce((sum, c) => sum + world[16 * above + 4 * c + k] * twist[c], 0),
  );
  const bone = [0, 1, 2].map((k) => world[b + k] - world[a + k]);
  const away = Math.hypot(
    axis[1] * bone[2] - axis[2] * bone[1],
    axis[2] * bone[0] - axis[0] * bone[2],
    axis[0] * bone[1] - axis[1] * bone[0],
  );
  return away <= 1e-9 * Math.hypot(bone[0], bone[1], bone[2]);
}

/** Six numbers for each DOF of a joint. */
function twistsAt(compiled: CompiledSkeleton, j: number, dofs: Float64Array): Float64Array {
  const first = compiled.firstDof[j];
  const count = compiled.firstDof[j + 1] - first;
  const local = new Float64Array(16);
  const out = new Float64Array(6 * count);
  compiled.motions[j].write(dofs, first, local, 0);
  writeTwists(compiled.motions[j], dofs, first, count, local, 0, out);
  return out;
}

/** Aims each pin at its target, or at the nearest point of its ball. The slots' matrices must be those of the pose. */
export function aimPins({ centre, radius }: Balls, pins: PinArrays, { worlds }: Slots): void {
  const { targets, aims } = pins;
  for (let p = 0; p < pins.count; p++) {
    const a = 3 * p;
    for (let k = a; k < a + 3; k++) aims[k] = targets[k];
    if (centre[p] < 0) continue;
    const c = 16 * centre[p] + 12;
    const x = targets[a] - worlds[c];
    const y = targets[a + 1] - worlds[c + 1];
    const z = targets[a + 2] - worlds[c + 2];
    // Well inside the ball, which needs no square root.
    if (x * x + y * y + z * z <= 0.99 * radius[p] * radius[p]) continue;
    const away = length3(x, y, z);
    if (!(away > radius[p])) continue;
    const part = radius[p] / away;
    aims[a] = worlds[c] + part * x;
    aims[a + 1] = worlds[c + 1] + part * y;
    aims[a + 2] = worlds[c + 2] + part * z;
  }
}

/** From the pivot of the matrix at `w[o]` to a point in its space. */
function distance(w: Float64Array, o: number, [x, y, z]: Vec3): number {
  const along = (k: number) => w[o + k] * x + w[o + 4 + k] * y + w[o + 8 + k] * z;
  return Math.hypot(along(0), along(1), along(2));
}

function pivotDistance(a: Float64Array, o: number, b: Float64Array, q: number): number {
  return Math.hypot(a[o + 12] - b[q + 12], a[o + 13] - b[q + 13], a[o + 14] - b[q + 14]);
}
