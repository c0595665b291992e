/** Positions of joints alone, and HumanML3D's numbers, from which they follow: bones are fitted to them. */
import { areTrees } from '../../evaluate/captured-frames.ts';
import { statedSpace } from '../../evaluate/space/metres.ts';
import { steadiestTree } from '../../evaluate/tree-fit/bones.ts';
import { type JointTree, knownCounts, SMPL_BODY, treesOf } from '../../evaluate/tree-fit/known-trees.ts';
import type { PointPaths } from '../../evaluate/tree-fit/point-paths.ts';
import { fitted } from '../fitted.ts';
import type { Remarks } from '../imported.ts';
import { rateOf } from './frames.ts';
import type { ArraysKind, ReadMotion } from './kind.ts';
import { fail, type Numbers } from './npy.ts';
import type { Arrays } from './npz.ts';

/** Names of the array, the first that has the shape counts. */
const NAMES = ['positions', 'joints', 'joints3d', 'keypoints'];
/** Numbers of HumanML3D a frame. */
const FEATURES = 263;
const FEATURES_RATE = 20;
/** Most joints of a tree of the file's own. */
const MAX_JOINTS = 10_000;

/** Positions of joints. */
export const POSITIONS: ArraysKind = {
  says: `positions of joints (T, J, 3) with J of ${knownCounts().join(', ')}, or with parents`,
  is: (arrays) => nameOfPositions(arrays) !== undefined,
  read: readPositions,
};

/** Motions of HumanML3D. */
export const HUMANML3D: ArraysKind = {
  says: `HumanML3D (T, ${FEATURES})`,
  is: (arrays) => nameOfFeatures(arrays) !== undefined,
  read: readFeatures,
};

function nameOfPositions(arrays: Arrays): string | undefined {
  const fits = (name: string) => {
    const shape = arrays.header(name)?.shape ?? [];
    if (shape.length !== 3 || (shape[2] !== 3 && shape[2] !== 4)) return false;
    return treesOf(shape[1]).length > 0 || arrays.header('parents')?.shape[0] === shape[1];
  };
  const named = NAMES.find(fits);
  if (named !== undefined) return named;
  const others = arrays.names.filter(fits);
  return others.length === 1 ? others[0] : undefined;
}

function readPositions(arrays: Arrays, remarks: Remarks): ReadMotion {
  const array = arrays.array(nameOfPositions(arrays) ?? '');
  const [frameCount = 0, pointCount = 0, width = 3] = array?.shape ?? [];
  if (!array || frameCount === 0) return fail('frames-missing', 'Expected frames of positions, found none.');
  const paths: PointPaths = { frameCount, pointCount, width, values: array.values };
  const tree = ownTree(arrays, pointCount) ?? knownTree(paths, remarks);
  return fitted(paths, tree, rateOf(arrays, remarks), remarks);
}

/** The tree of the file. */
function ownTree(arrays: Arrays, count: number): JointTree | undefined {
  const parents = arrays.array('parents')?.values;
  if (parents?.length !== count) return undefined;
  if (count > MAX_JOINTS) fail('numpy-large', `Expected at most ${MAX_JOINTS} joints, found ${count}.`);
  const list = Array.from(parents, (parent) => (parent < 0 ? -1 : parent));
  if (!areTrees(list)) fail('parents-loop', 'Expected in parents the index of another joint, or -1, found a loop.');
  const texts = arrays.array('names')?.texts ?? [];
  return {
    label: 'its own',
    names: texts.length === count ? texts : list.map((_, j) => `joint${j}`),
    parents: list,
    points: list.map((_, j): readonly [number] => [j]),
  };
}

function knownTree(paths: PointPaths, remarks: Remarks): JointTree {
  const trees = treesOf(paths.pointCount);
  const tree = steadiestTree(paths, trees);
  const others = trees.flatMap(({ label }) => (label === tree.label ? [] : [label]));
  const why = others.length > 0 ? `, whose bones vary less than those of ${others.join(' and ')}` : '';
  remarks.tell('tree-assumed', `Its ${paths.pointCount} joints have no names.`, `used those of ${tree.label}${why}`);
  return tree;
}

function nameOfFeatures(arrays: Arrays): string | undefined {
  const found = arrays.names.filter((name) => {
    const shape = arrays.header(name)?.shape ?? [];
    return shape.length === 2 && shape[1] === FEATURES;
  });
  return found.length === 1 ? found[0] : undefined;
}

function readFeatures(arrays: Arrays, remarks: Remarks): ReadMotion {
  const array = arrays.array(nameOfFeatures(arrays) ?? '');
  const frameCount = array?.shape[0] ?? 0;
  if (!array || frameCount === 0) return fail('frames-missing', 'Expected frames of HumanML3D, found none.');
  const { values } = array;
  let below = 0;
  for (let frame = 0; frame < frameCount; frame++) if (values[FEATURES * frame + 3] < 0) below++;
  if (2 * below >= frameCount) {
    const message = `The pelvis is below the ground in ${below} of ${frameCount} frames: the data is normalised. Multiply it by the deviation, add the mean (Std.npy, Mean.npy) and save that.`;
    remarks.warn('data-normalised', message, 'read as it is');
  }
  const positions = positionsOf(values, frameCount);
  const paths: PointPaths = { frameCount, pointCount: SMPL_BODY.length, width: 3, values: positions };
  const [tree] = treesOf(SMPL_BODY.length);
  return { ...fitted(paths, tree, rateOf(arrays, remarks, FEATURES_RATE), remarks), space: statedSpace(1) };
}

/**
 * Positions of 22 joints from rows of HumanML3D: [0] how far the body turns to the next frame, [1] and [2] how far it goes
 * along its own x and z, [3] the height of the pelvis, [4 …] the other joints from below the pelvis in the body's axes.
 * Guo et al., "Generating Diverse and Natural 3D Human Motions from Text", 2022: `recover_from_ric`.
 */
function positionsOf(values: Numbers, frameCount: number): Float64Array {
  const count = SMPL_BODY.length;
  const out = new Float64Array(3 * count * frameCount);
  let [turn, x, z] = [0, 0, 0];
  for (let frame = 0; frame < frameCount; frame++) {
    const row = FEATURES * frame;
    if (frame > 0) turn += values[row - FEATURES];
    const [cos, sin] = [Math.cos(2 * turn), Math.sin(2 * turn)];
    if (frame > 0) {
      const [a, b] = [values[row - FEATURES + 1], values[row - FEATURES + 2]];
      x += cos * a - sin * b;
      z += sin * a + cos * b;
    }
    const at = 3 * count * frame;
    out[at] = x;
    out[at + 1] = values[row + 3];
    out[at + 2] = z;
    for (let j = 1; j < count; j++) {
      const from = row + 4 + 3 * (j - 1);
      const [a, height, b] = [values[from], values[from + 1], values[from + 2]];
      out[at + 3 * j] = cos * a - sin * b + x;
      out[at + 3 * j + 1] = height;
      out[at + 3 * j + 2] = sin * a + cos * b + z;
    }
  }
  return out;
}
