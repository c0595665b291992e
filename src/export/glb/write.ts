/**
 * Writes a character as GLB: one scene with a node per joint below one that places the character, a skinned mesh, a
 * material with its texture, morph targets, and an animation per take.
 *
 * The same character and options give the same bytes.
 */

import { compileSkeleton } from '../../evaluate/kinematics.ts';
import { compileSkin } from '../../evaluate/skin/deform.ts';
import { NO_TRAVEL, placementMatrix } from '../../evaluate/space/placements.ts';
import { invertAffine } from '../../math/mat4.ts';
import { quaternionOfRotation } from '../../math/quaternion.ts';
import { transformPoint } from '../../math/vec3.ts';
import { type Character, DEFAULT_PLACEMENT } from '../../model/document.ts';
import { vertexCount } from '../../model/skin.ts';
import type { AttachmentSets } from '../shared/attachments.ts';
import { bodyPoints } from '../shared/body.ts';
import { type FileJoints, type FilePose, filePoseOf } from '../shared/file-pose.ts';
import { type JointNode, NODE_WIDTH, nodeWorlds, nodeWriter, ROTATION, SCALE } from '../shared/joint-nodes.ts';
import { lossesOf } from '../shared/losses.ts';
import { TOLERANCE_OF_SIZE } from '../shared/options.ts';
import {
  type ExchangeFile,
  type ExchangeProgress,
  exchangeFile,
  type Loss,
  type TakeReport,
} from '../shared/report.ts';
import { playedTakes, type TakeMotion, takeMotion } from '../shared/take-motion.ts';
import { BinaryChunk, type Json } from './container.ts';
import { type FitOptions, fitTake, type TrackKeys } from './fit/fit-take.ts';
import { type RigidPoint, WatchPoints } from './fit/watch-points.ts';
import { addMaterials } from './materials.ts';
import { addMesh } from './mesh.ts';
import type { GlbOptions } from './options.ts';
import { type Moment, rowWidth, type Track, tracksOf } from './tracks.ts';

/**
 * A character as a GLB file.
 * @param isPlaced whether it is where it is in the scene, upright and in metres, rather than in its own space
 * @param extra what else the JSON has: members of it, from the node of each joint
 * @throws TakeError, in a sentence, if a take can't be written or isn't there
 */
export function writeGlb(
  character: Character,
  options: GlbOptions,
  isPlaced: boolean,
  onProgress?: (progress: ExchangeProgress) => void,
  extra?: (nodes: readonly number[]) => Json,
): ExchangeFile {
  const chunk = new BinaryChunk();
  const filePose = filePoseOf(character, options);
  const { skin, joints, sets } = filePose;
  const placed = placementNode(character, isPlaced);
  const nodes: Json[] = [placed];
  const roots = [0];
  const takes = takesOf(character, options, filePose, onProgress);
  const resting = joints && sets?.hasStatic;
  if (joints) {
    const children = joints.nodes.nodes.map((): number[] => []);
    const own: number[] = [];
    joints.nodes.nodes.forEach(({ parent }, n) => {
      (parent < 0 ? own : children[parent]).push(FIRST_JOINT + n);
    });
    joints.nodes.nodes.forEach(({ joint, place }, n) => {
      const isLast = joints.nodes.lastOf[joint] === n;
      const { name } = joints.skeleton.joints[joint];
      nodes.push(
        nodeJson(isLast ? name : `${name || 'joint'}_part${place + 1}`, joints.rest, NODE_WIDTH * n, children[n]),
      );
    });
    if (resting) {
      own.push(nodes.length);
      nodes.push({ name: 'resting' });
    }
    nodes[0] = { ...placed, ...(own.length && { children: own }) };
  }
  const materials = skin && addMaterials(chunk, character, skin);
  let skins: readonly Json[] = [];
  let meshes: readonly Json[] = [];
  if (skin && vertexCount(skin) > 0) {
    const morphs = character.skins.length ? character.morphs : [];
    const morphWeights = filePose.restPose.slice(filePose.restPose.length - morphs.length);
    meshes = [addMesh(chunk, { skin, morphs, ...(sets && { sets }), morphWeights })];
    if (joints && sets) skins = [skinJson(chunk, filePose, joints, sets)];
    const meshNode = nodes.length;
    nodes.push({ name: skin.name, mesh: 0, ...(skins.length && { skin: 0 }) });
    // A skinned mesh is moved by its joints only, so it is a root; any other by what it hangs on.
    if (skins.length) roots.push(meshNode);
    else nodes[0] = { ...placed, children: [...childrenOf(nodes[0]), meshNode] };
  }
  const meshNode = nodes.length - 1;
  const animations = animationsOf(chunk, takes, filePose, meshNode);
  const pieces = chunk.file({
    asset: { version: '2.0', generator: 'Marrow' },
    scene: 0,
    scenes: [{ name: character.name, nodes: roots }],
    nodes,
    ...(meshes.length && { meshes }),
    ...(skins.length && { skins }),
    ...materials?.json,
    ...(animations.length && { animations: animations.map(({ json }) => json) }),
    ...extra?.(Array.from(joints?.nodes.lastOf ?? [], (node) => FIRST_JOINT + node)),
  });
  const motions = takes.map(({ motion }) => motion);
  const losses = [
    ...lossesOf({ character, options, format: 'glTF', filePose, motions, missing: materials?.missing ?? [] }),
    ...splines(options, motions),
  ];
  return exchangeFile(pieces, character, filePose, { takes: animations.map(({ report }) => report), losses });
}

function splines({ keys, framesPerSecond }: GlbOptions, motions: readonly TakeMotion[]): readonly Loss[] {
  if (keys !== 'cubic' || framesPerSecond !== undefined || motions.length === 0) return [];
  const message =
    'Blender ignores the tangents of cubic keys, so poses between keys are off there. Use linear keys for Blender.';
  return [{ code: 'splines-in-blender', severity: 'info', message }];
}

/** Index of the first joint's node. */
const FIRST_JOINT = 1;

interface WrittenTake {
  readonly motion: TakeMotion;
  readonly keys: readonly TrackKeys[];
}

function takesOf(
  character: Character,
  options: GlbOptions,
  filePose: FilePose,
  onProgress?: (progress: ExchangeProgress) => void,
): readonly WrittenTake[] {
  const { joints, skin, sets, size, tolerance } = filePose;
  if (!joints) return [];
  const played = playedTakes(character, options.take);
  const compiled = compileSkeleton(joints.skeleton);
  const { nodes } = joints.nodes;
  const weightsAt = NODE_WIDTH * nodes.length;
  const motions = played.flatMap((one) => takeMotion(one, nodeWriter(compiled, joints.nodes), weightsAt) ?? []);
  const own = character.skins.length > 0;
  const morphs = own ? character.morphs : [];
  const width = rowWidth(nodes.length, character.morphs.length);
  const moments = momentsOf(motions, nodes, width);
  const weightsOf = (m: number) => [0, ...moments.map(({ row }) => row[weightsAt + m])];
  const points = new WatchPoints(
    joints.skeleton,
    joints.nodes,
    axisLength(size, tolerance),
    skin &&
      sets && {
        compiled: compileSkin(skin),
        sets,
        morphs: {
          morphs,
          weightsAt,
          least: morphs.map((_, m) => Math.min(...weightsOf(m))),
          greatest: morphs.map((_, m) => Math.max(...weightsOf(m))),
        },
      },
  );
  if (own) points.addOutermost();
  else if (skin) for (const point of pointsOfBody(joints, size)) points.addPoint(point);
  const tracks = tracksOf(nodes, moments, points.watch, morphs.length);
  const moved = { nodes, points, tracks, width };
  return motions.map((motion, i) => {
    const fit: FitOptions = {
      style: options.keys,
      tolerance,
      size,
      ...(options.framesPerSecond !== undefined && { framesPerSecond: options.framesPerSecond }),
      onProgress: (part) => onProgress?.({ label: motion.name, fraction: (i + part) / motions.length }),
    };
    return { motion, keys: fitTake(motion, moved, fit) };
  });
}

/** Moments of each take, and of all takes at most, from which is seen how far its nodes reach. */
const MOMENTS = 24;
const MAX_MOMENTS = 240;

/** Moments at even distances, and the first and the last one, of some of the takes. */
function momentsOf(motions: readonly TakeMotion[], nodes: readonly JointNode[], width: number): readonly Moment[] {
  const every = Math.max(1, Math.ceil((motions.length * MOMENTS) / MAX_MOMENTS));
  return motions
    .filter((_, i) => i % every === 0)
    .flatMap((motion) =>
      Array.from({ length: MOMENTS }, (_, i) => {
        const row = new Float64Array(width);
        motion.write(motion.start + ((motion.end - motion.start) * i) / (MOMENTS - 1), row);
        const worlds = new Float64Array(16 * nodes.length);
        nodeWorlds(nodes, row, 0, worlds);
        return { row, worlds };
      }),
    );
}

/** Axes of joints may be off by so much in the world: 2°, with the margin that points have. */
const MAX_TURN = (2 * Math.PI) / 180;

/**
 * How long axes are that are off by the tolerance where they are turned too far; with a tolerance below the default one
 * they turn less, too.
 */
function axisLength(size: number, tolerance: number): number {
  return Math.max(tolerance, TOLERANCE_OF_SIZE * size) / MAX_TURN;
}

/** Points of the body that show how joints turn. */
function pointsOfBody({ skeleton, nodes: { lastOf }, worlds }: FileJoints, size: number): readonly RigidPoint[] {
  const inverse = new Float64Array(16);
  return bodyPoints({ skeleton, worlds, lastOf, size }).flatMap(({ joint, point: corner }) => {
    invertAffine(worlds, 16 * lastOf[joint], inverse, 0);
    const point = transformPoint(inverse, corner);
    return point.every(Number.isFinite) ? [{ joint, point }] : [];
  });
}

/** Animations of all takes: of each property of a node that changes in any of them. */
function animationsOf(chunk: BinaryChunk, takes: readonly WrittenTake[], filePose: FilePose, meshNode: number) {
  const { joints, restPose } = filePose;
  if (!joints) return [];
  const restOf = ({ at, width, path }: Track) =>
    path === 'weights' ? restPose.slice(restPose.length - width) : [...joints.rest.subarray(at, at + width)];
  const isMoved = new Set<number>();
  for (const { keys } of takes) {
    keys.forEach((track, t) => {
      if (!track.isConstant || !isSame(track, restOf(track.track))) isMoved.add(t);
    });
  }
  // An animation has at least one channel: the root's translation.
  if (isMoved.size === 0) isMoved.add(0);
  return takes.map(({ motion, keys }) => {
    const inputs = new Map<string, number>();
    const inputOf = (seconds: Float32Array<ArrayBuffer>) => {
      const name = `${seconds.length} ${fingerprint(seconds)}`;
      const known = inputs.get(name);
      if (known !== undefined) return known;
      const made = chunk.accessor('SCALAR', seconds, { bounds: true });
      inputs.set(name, made);
      return made;
    };
    const written = keys.filter((_, t) => isMoved.has(t));
    const samplers = written.map(({ track, interpolation, seconds, values }) => ({
      input: inputOf(seconds),
      output: chunk.accessor(track.path === 'weights' ? 'SCALAR' : track.path === 'rotation' ? 'VEC4' : 'VEC3', values),
      interpolation,
    }));
    const channels = written.map(({ track: { path, node } }, sampler) => ({
      sampler,
      target: { node: path === 'weights' ? meshNode : FIRST_JOINT + node, path },
    }));
    const report: TakeReport = {
      name: motion.name,
      seconds: motion.end - motion.start,
      channels: channels.length,
      keys: written.reduce((sum, { seconds }) => sum + seconds.length, 0),
    };
    return { json: { name: motion.name, channels, samplers }, report };
  });
}

/** Equal for equal numbers, and unequal for others but by a chance of one in 2⁵³. */
function fingerprint(values: Float32Array): string {
  const bits = new Uint32Array(values.buffer, values.byteOffset, values.length);
  let a = 0x811c9dc5;
  let b = 0x9e3779b9;
  for (const word of bits) {
    a = Math.imul(a ^ word, 0x01000193);
    b = Math.imul(b + word, 0x85ebca6b) ^ (b >>> 13);
  }
  return `${a} ${b}`;
}

function isSame({ values, track }: TrackKeys, rest: readonly number[]): boolean {
  const first = values.subarray(0, track.width);
  const dot = track.path === 'rotation' ? first.reduce((sum, v, k) => sum + v * rest[k], 0) : 1;
  const sign = dot < 0 ? -1 : 1;
  return first.every((v, k) => Math.abs(v - sign * rest[k]) <= 1e-6 * Math.max(1, Math.abs(v)));
}

function skinJson(chunk: BinaryChunk, { skin }: FilePose, joints: FileJoints, sets: AttachmentSets): Json {
  const { lastOf, nodes } = joints.nodes;
  const inverse = new Float64Array(16);
  const count = lastOf.length + (sets.hasStatic ? 1 : 0);
  const matrices = new Float32Array(16 * count);
  const compiled = skin && compileSkin(skin);
  lastOf.forEach((node, joint) => {
    const o = 16 * joint;
    if (compiled && joint < compiled.matrixCount) matrices.set(compiled.inverseBindings.subarray(o, o + 16), o);
    else {
      invertAffine(joints.worlds, 16 * node, inverse, 0);
      matrices.set(inverse.every(Number.isFinite) ? inverse : IDENTITY, o);
    }
    // Exactly, for the file: rounding may not change them.
    for (const k of [3, 7, 11]) matrices[o + k] = 0;
    matrices[o + 15] = 1;
  });
  if (sets.hasStatic) matrices.set(IDENTITY, 16 * lastOf.length);
  return {
    inverseBindMatrices: chunk.accessor('MAT4', matrices),
    joints: [
      ...Array.from(lastOf, (node) => FIRST_JOINT + node),
      ...(sets.hasStatic ? [FIRST_JOINT + nodes.length] : []),
    ],
  };
}

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

function childrenOf(node: Json): readonly number[] {
  // Only indices are put there.
  return (node.children as readonly number[] | undefined) ?? [];
}

/** The node that places the character in the scene: the first of its instances. */
function placementNode({ name, placements, space }: Character, isPlaced: boolean): Json {
  if (!isPlaced) return { name };
  const m = new Float64Array(16);
  placementMatrix(placements[0] ?? DEFAULT_PLACEMENT, space, NO_TRAVEL, m);
  const scale = Math.hypot(m[0], m[1], m[2]);
  const nine = new Float64Array(9);
  for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) nine[3 * c + r] = m[4 * c + r] / scale;
  const q = new Float64Array(4);
  quaternionOfRotation(nine, 0, q);
  return nodeJson(name, Float64Array.of(m[12], m[13], m[14], ...q, scale, scale, scale), 0, []);
}

/** A node with what of its numbers differs from the default. */
function nodeJson(name: string, row: Float64Array, o: number, children: readonly number[]): Json {
  const numbers = (from: number, to: number) => Array.from(row.subarray(o + from, o + to), (v) => Math.fround(v) + 0);
  const translation = numbers(0, 3);
  const rotation = numbers(ROTATION, ROTATION + 4);
  const scale = numbers(SCALE, SCALE + 3);
  return {
    ...(name && { name }),
    ...(translation.some((v) => v !== 0) && { translation }),
    ...(rotation.slice(0, 3).some((v) => v !== 0) && { rotation }),
    ...(scale.some((v) => v !== 1) && { scale }),
    ...(children.length && { children }),
  };
}
