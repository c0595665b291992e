/**
 * Motions of SMPL's family, as AMASS and others store them: axis-angle vectors of all joints (`poses`), or in parts, with
 * the translation of the pelvis. Shapes are ignored: offsets come from joints at rest in the file, from joints in
 * each frame, or are those of a neutral adult.
 */
import { median } from '../../evaluate/tree-fit/bones.ts';
import type { Remarks } from '../imported.ts';
import { framesOf, multiplyInto, rateOf, turnBack, widthOf, writeOfVector } from './frames.ts';
import type { ArraysKind, ReadMotion } from './kind.ts';
import { fail, type Numbers, type NumpyArray, shapeText } from './npy.ts';
import type { Arrays } from './npz.ts';
import { type BodyCount, bodyTree } from './smpl-tree.ts';

/** Names of each part. */
const ROOT = ['global_orient', 'root_orient'];
const BODY = ['body_pose', 'pose_body'];
const LEFT_HAND = ['left_hand_pose'];
const RIGHT_HAND = ['right_hand_pose'];
const HANDS = ['pose_hand'];
const JAW = ['jaw_pose', 'pose_jaw'];
const LEFT_EYE = ['leye_pose'];
const RIGHT_EYE = ['reye_pose'];
const EYES = ['pose_eye'];
const FACE = [...JAW, ...LEFT_EYE, ...RIGHT_EYE, ...EYES];
const WHERE = ['trans', 'transl'];
/** Ignored: shapes of bodies. */
const SHAPES = ['betas', 'dmpls', 'expression'];

/** Numbers of the vectors of a hand. */
const HAND = 45;
/** Frames that offsets are measured in. */
const MEASURED = 4096;

/** Motions of SMPL, SMPL-H and SMPL-X. */
export const SMPL: ArraysKind = {
  says: 'poses or body_pose of the SMPL family, such as AMASS',
  is: (arrays) => arrays.has('poses') || (hasOne(arrays, ROOT) && hasOne(arrays, BODY)),
  read: readSmpl,
};

/** Whether a file has the shape of a body alone, such as `shape.npz` and `…_stagei.npz` of AMASS. */
export function isShapeAlone(arrays: Arrays): boolean {
  return arrays.has('betas') && !hasOne(arrays, ['poses', ...ROOT, ...BODY, ...WHERE]);
}

function hasOne(arrays: Arrays, names: readonly string[]): boolean {
  return names.some((name) => arrays.has(name));
}

function readSmpl(arrays: Arrays, remarks: Remarks): ReadMotion {
  const { frameCount, count, values } = arrays.has('poses') ? wholePoses(arrays) : posesInParts(arrays, remarks);
  const { names, parents, offsets: neutral } = bodyTree(count);
  const writeRotations = (frame: number, out: Float64Array) => {
    for (let j = 0, at = 3 * frame * count; j < count; j++, at += 3) {
      writeOfVector(values[at], values[at + 1], values[at + 2], out, 4 * j);
    }
  };
  const trans = framesOf(arrays, WHERE, frameCount, 3);
  const found = restOffsets(arrays, parents) ?? framedOffsets(arrays, parents, frameCount, writeRotations, trans);
  if (!found) {
    const message = 'The file has no joints at rest (J), so bones have neutral proportions, those of an adult.';
    remarks.tell('neutral-proportions', message, 'used a neutral body');
  }
  tellNotes(arrays, remarks);
  const offsets = found ?? Float64Array.from(neutral.flat());
  return {
    joints: { names, parents, offsets, moves: parents.map((parent) => parent < 0) },
    frames: {
      frameCount,
      framesPerSecond: rateOf(arrays, remarks),
      write(frame, rotations, places) {
        writeRotations(frame, rotations);
        for (let k = 0; k < 3; k++) places[k] = offsets[k] + (trans ? trans[3 * frame + k] : 0);
      },
    },
    up: arrays.has('global_orient') && !arrays.has('poses') && standsAlongY(values, frameCount, count) ? 'y' : 'z',
  };
}

/** What of the file is not used, and what it says of the person. */
function tellNotes(arrays: Arrays, remarks: Remarks): void {
  const shapes = SHAPES.filter((name) => arrays.has(name));
  if (shapes.length > 0)
    remarks.tell('shape-ignored', `The shape of the body (${shapes.join(', ')}) is not read.`, 'left out');
  const header = arrays.header('gender');
  const gender = header && 'US'.includes(header.type) ? arrays.array('gender')?.texts[0] : undefined;
  if (gender) remarks.tell('gender-noted', `The file gives the gender ${JSON.stringify(gender)}.`);
}

/** Axis-angle vectors of all joints, frame by frame. */
interface Poses {
  readonly frameCount: number;
  readonly count: BodyCount;
  readonly values: Numbers;
}

function wholePoses(arrays: Arrays): Poses {
  const poses = arrays.array('poses');
  const count = poses ? widthOf(poses) / 3 : 0;
  if (!poses || poses.shape[0] === 0) return fail('frames-missing', 'Expected frames in poses, found none.');
  if (count !== 24 && count !== 52 && count !== 55) {
    return fail(
      'poses-width',
      `Expected 72, 156 or 165 numbers a frame in poses, found the shape ${shapeText(poses)}.`,
    );
  }
  return { frameCount: poses.shape[0], count, values: poses.values };
}

function posesInParts(arrays: Arrays, remarks: Remarks): Poses {
  const part = (names: readonly string[]): NumpyArray | undefined => {
    const name = names.find((own) => arrays.has(own));
    return name === undefined ? undefined : arrays.array(name);
  };
  const [root, body] = [part(ROOT), part(BODY)];
  const frameCount = root?.shape[0] ?? 0;
  if (!root || !body || frameCount === 0)
    return fail('frames-missing', 'Expected frames of the root and the body, found none.');
  const width = widthOf(body);
  if (widthOf(root) !== 3 || (width !== 63 && width !== 69)) {
    const found = `${root.name} ${shapeText(root)} and ${body.name} ${shapeText(body)}`;
    fail('poses-width', `Expected 3 numbers a frame of the root and 63 or 69 of the body, found ${found}.`);
  }
  const count: BodyCount = width === 69 ? 24 : hasOne(arrays, FACE) ? 55 : 52;
  const values = new Float64Array(3 * frameCount * count);
  const put = (array: NumpyArray | undefined, joint: number, expected = array ? widthOf(array) : 0) => {
    if (!array) return;
    if (array.shape[0] !== frameCount || widthOf(array) !== expected) {
      const wanted = `${frameCount} frames of ${expected} numbers`;
      fail('arrays-shape', `Expected ${wanted} in ${array.name}, found the shape ${shapeText(array)}.`);
    }
    for (let frame = 0; frame < frameCount; frame++) {
      const at = 3 * (frame * count + joint);
      for (let k = 0; k < expected; k++) values[at + k] = array.values[frame * expected + k];
    }
  };
  put(root, 0, 3);
  put(body, 1, width);
  if (count === 24) return { frameCount, count, values };
  if (count === 55) {
    put(part(JAW), 22, 3);
    put(part(LEFT_EYE), 23, 3);
    put(part(RIGHT_EYE), 24, 3);
    put(part(EYES), 23, 6);
  }
  const hand = count === 55 ? 25 : 22;
  const coded: string[] = [];
  const putHand = (array: NumpyArray | undefined, joint: number, expected: number) => {
    if (array && widthOf(array) !== expected) coded.push(array.name);
    else put(array, joint, expected);
  };
  putHand(part(HANDS), hand, 2 * HAND);
  putHand(part(LEFT_HAND), hand, HAND);
  putHand(part(RIGHT_HAND), hand + HAND / 3, HAND);
  if (coded.length > 0) {
    const message = `${coded.join(' and ')}: the width is that of coefficients, not of angles.`;
    remarks.tell('hands-coded', message, 'hands at rest');
  }
  return { frameCount, count, values };
}

/** x y z of each joint in its parent's space, the root's its place at rest; undefined if the file doesn't say. */
function restOffsets(arrays: Arrays, parents: readonly number[]): Float64Array | undefined {
  for (const name of ['J', 'rest_joints', 'joints', 'offsets']) {
    const shape = arrays.header(name)?.shape ?? [];
    if (shape.at(-1) !== 3 || shape.at(-2) !== parents.length || shape.slice(0, -2).some((n) => n !== 1)) continue;
    const values = arrays.array(name)?.values;
    if (!values) continue;
    return Float64Array.from(values, (v, i) => {
      const parent = parents[Math.floor(i / 3)];
      return parent < 0 || name === 'offsets' ? v : v - values[3 * parent + (i % 3)];
    });
  }
  return undefined;
}

/** The same from where the joints are in each frame: the median of where each is in its parent's space. */
function framedOffsets(
  arrays: Arrays,
  parents: readonly number[],
  frameCount: number,
  writeRotations: (frame: number, out: Float64Array) => void,
  trans: Numbers | undefined,
): Float64Array | undefined {
  const shape = arrays.header('joints')?.shape ?? [];
  const count = parents.length;
  if (shape.length !== 3 || shape[0] !== frameCount || shape[1] !== count || shape[2] !== 3) return undefined;
  const placed = arrays.array('joints')?.values;
  if (!placed) return undefined;
  const measured = Math.min(frameCount, MEASURED);
  const all = Array.from({ length: 3 * count }, () => new Float64Array(measured));
  const local = new Float64Array(4 * count);
  const world = new Float64Array(4 * count);
  const own = new Float64Array(3);
  for (let i = 0; i < measured; i++) {
    const frame = Math.floor((i * frameCount) / measured);
    const from = 3 * frame * count;
    writeRotations(frame, local);
    parents.forEach((parent, j) => {
      if (parent < 0) {
        world.set(local.subarray(4 * j, 4 * j + 4), 4 * j);
        // The pelvis is where it is at rest, moved.
        for (let k = 0; k < 3; k++) own[k] = placed[from + 3 * j + k] - (trans ? trans[3 * frame + k] : 0);
      } else {
        multiplyInto(world, 4 * parent, local, 4 * j, world, 4 * j);
        for (let k = 0; k < 3; k++) own[k] = placed[from + 3 * j + k] - placed[from + 3 * parent + k];
        turnBack(world, 4 * parent, own, own, 0);
      }
      for (let k = 0; k < 3; k++) all[3 * j + k][i] = own[k];
    });
  }
  return Float64Array.from(all, median);
}

/** Whether the body is upright along y, not z, in most frames. */
function standsAlongY(values: Numbers, frameCount: number, count: number): boolean {
  const up = Float64Array.of(0, 1, 0);
  const turned = new Float64Array(3);
  const rotation = new Float64Array(4);
  let upright = 0;
  for (let frame = 0; frame < frameCount; frame++) {
    const at = 3 * frame * count;
    // Turned back by the opposite vector is turned.
    writeOfVector(-values[at], -values[at + 1], -values[at + 2], rotation, 0);
    turnBack(rotation, 0, up, turned, 0);
    if (Math.abs(turned[1]) > Math.abs(turned[2])) upright++;
  }
  return 2 * upright > frameCount;
}
