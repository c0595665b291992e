/** The arrays that `marrow export` writes: `names`, `parents`, `offsets`, `local_quat`, and what else there is. */
import { areTrees, type FrameJoints } from '../../evaluate/captured-frames.ts';
import { statedSpace } from '../../evaluate/space/metres.ts';
import type { Vec3 } from '../../math/vec3.ts';
import type { FileSpace } from '../../model/space.ts';
import type { Remarks } from '../imported.ts';
import { holdMissing, POINT_WIDTH } from '../points/table.ts';
import { framesOf, rateOf, turnBack } from './frames.ts';
import type { ArraysKind, ReadMotion } from './kind.ts';
import { fail, type Numbers, type NumpyArray } from './npy.ts';
import type { Arrays } from './npz.ts';

/** How far a joint may be off its offset, as a fraction of the size, before it has positions of its own. */
const STILL = 1e-6;

/** Takes exported by Marrow, and others of the same layout. */
export const OWN: ArraysKind = {
  says: 'names and local_quat, as "marrow export" writes them',
  is: (arrays) => arrays.has('names') && arrays.has('local_quat'),
  read: readOwn,
};

function readOwn(arrays: Arrays, remarks: Remarks): ReadMotion {
  const names = arrays.array('names')?.texts ?? [];
  const count = names.length;
  const turns = arrays.array('local_quat');
  const parents = arrays.array('parents')?.values ?? [];
  const offsets = arrays.array('offsets')?.values ?? [];
  const frameCount = turns?.shape[0] ?? 0;
  if (!turns || frameCount === 0 || count === 0)
    return fail('frames-missing', 'Expected joints and frames, found none.');
  if (turns.values.length !== 4 * count * frameCount || parents.length !== count || offsets.length !== 3 * count) {
    const found = `${count} names, ${parents.length} parents, ${offsets.length / 3} offsets`;
    fail('arrays-shape', `Expected parents, offsets and local_quat (T, J, 4) of ${count} joints, found ${found}.`);
  }
  if (!areTrees(parents)) fail('parents-loop', 'Expected in parents the index of another joint, or -1, found a loop.');
  const places = pointsOf(arrays, parents, turns);
  if (places) {
    const framesPerSecond = rateOf(arrays, remarks);
    return { points: { labels: names, frameCount, framesPerSecond, values: places }, ...spaceOf(arrays) };
  }
  const world = worldOf(arrays, frameCount, count);
  const roots = world ? undefined : framesOf(arrays, ['root_positions'], frameCount, 3);
  const ends = endsOf(arrays, names, frameCount, world);
  const joints: FrameJoints = {
    ...{ names, parents, offsets },
    moves: movingJoints(parents, offsets, frameCount, world),
    ...(ends.size > 0 && { endSites: ends }),
  };
  const firstRoot = Array.from(parents).findIndex((parent) => parent < 0);
  const rotations = turns.values;
  return {
    joints,
    frames: {
      frameCount,
      framesPerSecond: rateOf(arrays, remarks),
      write(frame, out, places) {
        const from = 4 * frame * count;
        for (let k = 0; k < 4 * count; k++) out[k] = rotations[from + k];
        if (world) return writePlaces(world, parents, frame, places);
        for (let k = 0; k < 3 * count; k++) places[k] = offsets[k];
        if (roots) for (let k = 0; k < 3; k++) places[3 * firstRoot + k] = roots[3 * frame + k];
      },
    },
    ...spaceOf(arrays),
  };
}

/**
 * Where points are, `POINT_WIDTH` numbers each; undefined of a skeleton. Points are roots that never turn, and NaN
 * where they are missing; a skeleton has one root.
 */
function pointsOf(arrays: Arrays, parents: ArrayLike<number>, turns: NumpyArray): Float64Array | undefined {
  const count = parents.length;
  const isStill = (value: number, i: number) => value === (i % 4 === 3 ? 1 : 0);
  if (!arrays.has('positions') || !Array.from(parents).every((p) => p < 0) || !turns.values.every(isStill))
    return undefined;
  const positions = arrays.array('positions', true)?.values;
  const frameCount = turns.shape[0];
  if (positions?.length !== 3 * count * frameCount) return undefined;
  if (count === 1 && !positions.some(Number.isNaN)) return undefined;
  const values = new Float64Array(POINT_WIDTH * count * frameCount);
  for (let from = 0, to = 0; from < positions.length; from += 3, to += POINT_WIDTH) {
    if (Number.isNaN(positions[from] + positions[from + 1] + positions[from + 2])) continue;
    for (let k = 0; k < 3; k++) values[to + k] = positions[from + k];
    values[to + 3] = 1;
  }
  holdMissing(values, count, frameCount);
  return values;
}

/** Positions and rotations of joints in the world, frame by frame. */
interface WorldFrames {
  readonly positions: Numbers;
  readonly rotations: Numbers;
}

function worldOf(arrays: Arrays, frameCount: number, count: number): WorldFrames | undefined {
  if (!arrays.has('positions') || !arrays.has('world_quat')) return undefined;
  const positions = framesOf(arrays, ['positions'], frameCount, 3 * count);
  const rotations = framesOf(arrays, ['world_quat'], frameCount, 4 * count);
  return positions && rotations && { positions, rotations };
}

/** Writes where each joint is in its parent's space. */
function writePlaces(
  { positions, rotations }: WorldFrames,
  parents: ArrayLike<number>,
  frame: number,
  out: Float64Array,
) {
  const count = parents.length;
  const from = frame * count;
  for (let j = 0; j < count; j++) {
    const parent = parents[j];
    const at = 3 * (from + j);
    if (parent < 0) {
      for (let k = 0; k < 3; k++) out[3 * j + k] = positions[at + k];
      continue;
    }
    const above = 3 * (from + parent);
    for (let k = 0; k < 3; k++) way[k] = positions[at + k] - positions[above + k];
    turnBack(rotations, 4 * (from + parent), way, out, 3 * j);
  }
}

/** Roots, and joints that are elsewhere than at their offsets. */
function movingJoints(
  parents: ArrayLike<number>,
  offsets: ArrayLike<number>,
  frameCount: number,
  world: WorldFrames | undefined,
): readonly boolean[] {
  const moves = Array.from(parents, (parent) => parent < 0);
  if (!world) return moves;
  const places = new Float64Array(3 * moves.length);
  const most = STILL * sizeOf(world.positions.subarray(0, places.length));
  for (let frame = 0; frame < frameCount; frame++) {
    writePlaces(world, parents, frame, places);
    for (let j = 0; j < moves.length; j++) {
      if (moves[j]) continue;
      for (let k = 3 * j; k < 3 * j + 3; k++) if (Math.abs(places[k] - offsets[k]) > most) moves[j] = true;
    }
  }
  return moves;
}

/** The longest side of the box around some points. */
function sizeOf(points: Numbers): number {
  let size = 0;
  for (let k = 0; k < 3; k++) {
    let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
    for (let i = k; i < points.length; i += 3) {
      low = Math.min(low, points[i]);
      high = Math.max(high, points[i]);
    }
    size = Math.max(size, high - low);
  }
  return size;
}

/** End Sites in the spaces of their joints: as they are listed, or from where they are in the first frame. */
function endsOf(
  arrays: Arrays,
  names: readonly string[],
  frameCount: number,
  world: WorldFrames | undefined,
): ReadonlyMap<number, readonly Vec3[]> {
  const ends = new Map<number, Vec3[]>();
  const endNames = arrays.array('end_names')?.texts ?? [];
  if (endNames.length === 0) return ends;
  const count = endNames.length;
  const listed = arrays.array('end_parents')?.values;
  const offsets = arrays.array('end_offsets')?.values;
  const places = listed && offsets ? undefined : framesOf(arrays, ['end_positions'], frameCount, 3 * count);
  const out = new Float64Array(3);
  endNames.forEach((name, e) => {
    const joint = listed?.[e] ?? names.indexOf(name.replace(/_end\d*$/, ''));
    if (!(Number.isInteger(joint) && joint >= 0 && joint < names.length)) return;
    if (listed && offsets?.length === 3 * count) for (let k = 0; k < 3; k++) out[k] = offsets[3 * e + k];
    else {
      if (!places || !world) return;
      for (let k = 0; k < 3; k++) way[k] = places[3 * e + k] - world.positions[3 * joint + k];
      turnBack(world.rotations, 4 * joint, way, out, 0);
    }
    const own = ends.get(joint) ?? [];
    own.push([out[0], out[1], out[2]]);
    ends.set(joint, own);
  });
  return ends;
}

/** Metres, y up, unless `meta` says that the numbers are those of another file: then as it says of that. */
function spaceOf(arrays: Arrays): { readonly space?: FileSpace } {
  const header = arrays.header('meta');
  const text = header?.type === 'U' || header?.type === 'S' ? arrays.array('meta')?.texts[0] : undefined;
  const meta = text === undefined ? undefined : parsed(text);
  if (meta?.raw !== true) return { space: statedSpace(1) };
  const { up, metresPerUnit, lift } = isRecord(meta.file) ? meta.file : {};
  if ((up !== 'y' && up !== 'z' && up !== '-y') || !isNumber(metresPerUnit) || metresPerUnit <= 0) return {};
  const { space } = statedSpace(metresPerUnit);
  return { space: { space: { ...space, up, lift: isNumber(lift) ? lift : 0 }, standing: 0 } };
}

function parsed(text: string): Readonly<Record<string, unknown>> | undefined {
  try {
    const value: unknown = JSON.parse(text);
    return isRecord(value) ? value : undefined;
  } catch {
    return undefined;
  }
}

function isRecord(value: unknown): value is Readonly<Record<string, unknown>> {
  return typeof value === 'object' && value !== null;
}

function isNumber(value: unknown): value is number {
  return typeof value === 'number' && Number.isFinite(value);
}

/** Scratch; never escapes. */
const way = new Float64Array(3);
