/** Makes a character of a scene: joints, one skin, morphs and takes. */

import { computeNormals } from '../evaluate/skin/normals.ts';
import { statedSpace } from '../evaluate/space/metres.ts';
import { inverseTranspose3, isSingular, multiplyAffine, setIdentity } from '../math/mat4.ts';
import { writeRotation } from '../math/quaternion.ts';
import type { WholeCharacter } from '../model/files.ts';
import type { Morph, MorphRows } from '../model/morph.ts';
import { cutText } from '../model/names/cut-text.ts';
import { DistinctNames } from '../model/names/distinct-names.ts';
import { carriesCharacter } from '../model/skeleton/joint-types.ts';
import { type Joint, NO_BOX, type Skeleton, UNLIMITED } from '../model/skeleton/skeleton.ts';
import type { Attachments, Material, Skin, Surface } from '../model/skin.ts';
import { type Channel, restChannel, type Take } from '../model/takes/take.ts';
import type { TrackedDof } from '../model/takes/tracked-take.ts';
import { type Binding, type BoundMesh, bindMeshes, inverted } from './bind.ts';
import { cleanFileName, cleanName } from './clean-names.ts';
import { firstNotFinite } from './finite.ts';
import { SPARE_KEYS } from './fit-rotation.ts';
import { takeOfTracks } from './fit-take.ts';
import { ImportError } from './imported.ts';
import { type JointMotion, jointMotion } from './joint-motions.ts';
import type { Scene, SceneMesh, SceneMove, SceneTake } from './scene.ts';

/** A joint to be: of a node, a further one below it, or the one above several roots. */
interface Slot {
  readonly name: string;
  /** Index of a slot; -1 for the root. */
  readonly parent: number;
  /** -1 for joints that nothing moves. */
  readonly node: number;
  readonly inverse: Float64Array | undefined;
}

/**
 * Undefined if it has neither a mesh nor anything that moves.
 *
 * @throws {ImportError} if a node or a vertex is farther away than numbers go
 */
export function toCharacter(scene: Scene): WholeCharacter | undefined {
  const { name, metres, nodes, meshes, takes } = scene;
  const worlds = worldsOf(scene);
  const far = worlds.findIndex((value) => !Number.isFinite(value));
  if (far >= 0) throw tooFar(`Node "${cutText(nodes[far >> 4].name)}"`);
  const binding = bindMeshes(meshes, worlds);
  const { slots, slotOf, furtherOf } = jointSlots(scene, binding);
  if (slots.length === 0) return undefined;
  const size = sizeOf(scene, worlds, binding);
  const movesOf = takes.map(({ moves }) => new Map(moves.map((move) => [move.node, move])));
  const motions = slots.map(({ node }): JointMotion | undefined => {
    if (node < 0) return undefined;
    const moves = movesOf.flatMap((own) => own.get(node) ?? []);
    return jointMotion(nodes[node], moves, size / stretchOf(worlds, nodes[node].parent));
  });
  const joints = slots.map((slot, j): Joint => {
    const { motion, offset, pose } = motions[j] ?? FIXED;
    const role = nodes[slot.node]?.role;
    return {
      name: slot.name,
      parent: slot.parent,
      offset: [offset[0] + 0, offset[1] + 0, offset[2] + 0],
      box: NO_BOX,
      motion,
      limits: pose.map(() => UNLIMITED),
      pose: pose.map((value) => value + 0),
      ...(role && { role }),
    };
  });
  const skeleton: Skeleton = { name, joints };
  const jointsOf = (bound: BoundMesh) => bound.joints.map((at) => (at < 0 ? furtherOf[-1 - at] : slotOf[at]));
  const skins = meshes.length ? [skinOf(scene, binding, jointsOf, bindingsOf(slots, worlds))] : [];
  const { morphs, weightsOf } = morphsOf(meshes, binding);
  const takeNames = new DistinctNames();
  const spareKeys = Math.floor(SPARE_KEYS / takes.length);
  const animations = takes.map((take, t): Take => {
    const head = {
      name: takeNames.add(cleanFileName(take.name) || `animation_${t}`),
      range: take.range,
      ...(take.framesPerSecond !== undefined && { framesPerSecond: take.framesPerSecond }),
    };
    const channels = [...jointChannels(joints, slots, motions, movesOf[t]), ...weightsOf(take)];
    return channels.every(isChannel) ? { ...head, channels } : takeOfTracks({ ...head, tracked: channels, spareKeys });
  });
  return { skeleton, skins, morphs, takes: animations, textures: scene.textures, space: statedSpace(metres) };
}

const FIXED: Pick<JointMotion, 'motion' | 'offset' | 'pose'> = {
  motion: { kind: 'fixed' },
  offset: [0, 0, 0],
  pose: [],
};

function worldsOf({ nodes }: Scene): Float64Array {
  const worlds = new Float64Array(16 * nodes.length);
  const local = new Float64Array(16);
  nodes.forEach(({ parent, translation, rotation, scale }, n) => {
    setIdentity(local);
    writeRotation(...rotation, local, 0, 4);
    for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) local[4 * c + r] *= scale[c];
    local.set(translation, 12);
    if (parent < 0) worlds.set(local, 16 * n);
    else multiplyAffine(worlds, 16 * parent, local, 0, worlds, 16 * n);
  });
  return worlds;
}

/** By how much a node makes lengths below it larger, at most; 1 for none, and for one that flattens all. */
function stretchOf(worlds: Float64Array, node: number): number {
  if (node < 0) return 1;
  const [x, y, z] = [0, 4, 8].map((c) => 16 * node + c).map((o) => Math.hypot(...worlds.subarray(o, o + 3)));
  return Math.max(x, y, z) || 1;
}

/** The joints in depth-first order: nodes that a character needs, with those above them. */
function jointSlots({ nodes, meshes, takes }: Scene, { inverse, further }: Binding) {
  const isNeeded = nodes.map(({ isBone, role }) => (isBone ?? false) || role !== undefined);
  for (const { node, skinned } of meshes) {
    isNeeded[node] = true;
    for (const joint of skinned?.skin.joints ?? []) isNeeded[joint] = true;
  }
  for (const { moves } of takes) for (const { node } of moves) isNeeded[node] = true;
  for (let n = nodes.length - 1; n >= 0; n--) if (isNeeded[n] && nodes[n].parent >= 0) isNeeded[nodes[n].parent] = true;
  const roots = nodes.filter(({ parent }, n) => parent < 0 && isNeeded[n]).length;
  const slots: Slot[] = [];
  const slotOf: number[] = [];
  const furtherOf: number[] = [];
  if (roots > 1) slots.push({ name: 'scene', parent: -1, node: -1, inverse: undefined });
  nodes.forEach(({ name, parent }, node) => {
    if (!isNeeded[node]) return;
    slotOf[node] = slots.length;
    const above = parent >= 0 ? slotOf[parent] : roots > 1 ? 0 : -1;
    slots.push({ name: cleanName(name), parent: above, node, inverse: inverse.get(node) });
    further.forEach((joint, f) => {
      if (joint.node !== node) return;
      furtherOf[f] = slots.length;
      slots.push({ name: `${cleanName(name)}_bind`, parent: slotOf[node], node: -1, inverse: joint.inverse });
    });
  });
  return { slots, slotOf, furtherOf };
}

/** Diagonal of the box around joints and vertices at rest; 1 if that is a point. */
function sizeOf({ meshes }: Scene, worlds: Float64Array, binding: Binding): number {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  const include = (points: Float64Array, stride: number) => {
    for (let k = 0; k < 3; k++) {
      let low = min[k];
      let high = max[k];
      for (let o = k; o < points.length; o += stride) {
        low = Math.min(low, points[o]);
        high = Math.max(high, points[o]);
      }
      min[k] = low;
      max[k] = high;
    }
  };
  include(worlds.subarray(12), 16);
  for (const [m, { positions }] of meshes.entries()) include(movedBy(binding.meshes[m].matrix, positions, 1), 3);
  const size = Math.hypot(...max.map((value, k) => value - min[k]));
  return size > 0 && size < Infinity ? size : 1;
}

/** @param w 1 for points, 0 for directions */
function movedBy(m: Float64Array | undefined, values: Float64Array, w: 0 | 1): Float64Array {
  if (!m) return values;
  const n = new Float64Array(9);
  inverseTranspose3(m, 0, n, 0);
  const [a, stride] = w ? [m, 4] : [n, 3];
  const out = new Float64Array(values.length);
  for (let v = 0; v < values.length; v += 3) {
    const x = values[v];
    const y = values[v + 1];
    const z = values[v + 2];
    for (let r = 0; r < 3; r++) {
      out[v + r] = a[r] * x + a[stride + r] * y + a[2 * stride + r] * z + (w ? m[12 + r] : 0);
    }
  }
  return out;
}

function tooFar(what: string): ImportError {
  return new ImportError('scene-too-large', `${what} is too far away or too large for a number (1.8e308 at most).`);
}

/** Bindings of each joint; one without vertices has its rest. */
function bindingsOf(slots: readonly Slot[], worlds: Float64Array): Float64Array {
  const out = new Float64Array(16 * slots.length);
  slots.forEach(({ inverse, node }, j) => {
    const own = inverse ? inverted(inverse) : node < 0 ? undefined : worlds.slice(16 * node, 16 * node + 16);
    if (own && !isSingular(own) && own.every(Number.isFinite)) out.set(own, 16 * j);
    else setIdentity(out, 16 * j);
  });
  return out;
}

function skinOf(
  { name, nodes, meshes, materials }: Scene,
  binding: Binding,
  jointsOf: (bound: BoundMesh) => readonly number[],
  bindings: Float64Array,
): Skin {
  const total = meshes.reduce((sum, { positions }) => sum + positions.length / 3, 0);
  const hasNormals = meshes.some((mesh) => mesh.normals);
  const hasTexcoords = meshes.some((mesh) => mesh.texcoords);
  const positions: Float64Array[] = [];
  const normals: Float64Array[] = [];
  const texcoords: Float64Array[] = [];
  const triangles: Uint32Array[] = [];
  const surfaces: Surface[] = [];
  const names = new DistinctNames();
  const finished = materials.map((material, i): Material => {
    const { color, texture } = material;
    const called = names.add(cleanName(material.name) || `material_${i}`);
    return { name: called, ...(color && { color }), ...(texture !== undefined && { texture }) };
  });
  const otherwise: Material = { name: names.add('default') };
  let first = 0;
  let triangleStart = 0;
  meshes.forEach((mesh, m) => {
    const { matrix } = binding.meshes[m];
    const moved = movedBy(matrix, mesh.positions, 1);
    if (firstNotFinite(moved) >= 0) throw tooFar(`A vertex of "${cutText(nodes[mesh.node].name)}"`);
    const { length } = mesh.positions;
    positions.push(moved);
    if (hasNormals)
      normals.push(mesh.normals ? movedBy(matrix, mesh.normals, 0) : new Float64Array(length).fill(Number.NaN));
    if (hasTexcoords) texcoords.push(mesh.texcoords ?? new Float64Array((2 * length) / 3));
    for (const { material: index, triangles: own } of mesh.surfaces) {
      triangles.push(raised(own, first));
      const material = finished[index] ?? (surfaces.length ? otherwise : undefined);
      const triangleCount = own.length / 3;
      const last = surfaces.at(-1);
      if (last && (last.material === material || (!last.material && material === otherwise))) {
        surfaces[surfaces.length - 1] = { ...last, triangleCount: last.triangleCount + triangleCount };
      } else surfaces.push({ ...(material && { material }), triangleStart, triangleCount });
      triangleStart += triangleCount;
    }
    first += length / 3;
  });
  const all = joined(triangles, Uint32Array);
  const points = joined(positions, Float64Array);
  return {
    name,
    positions: points,
    ...(hasNormals && { normals: completed(joined(normals, Float64Array), points, all) }),
    ...(hasTexcoords && { texcoords: joined(texcoords, Float64Array) }),
    attachments: attachmentsOf(meshes, binding, jointsOf, total),
    triangles: all,
    surfaces: surfaces.length ? surfaces : [{ triangleStart: 0, triangleCount: 0 }],
    bindings,
  };
}

/** One list after the other; the list itself if there is only one. */
function joined<A extends Float64Array | Uint32Array>(lists: readonly A[], Numbers: new (length: number) => A): A {
  if (lists.length === 1) return lists[0];
  const all = new Numbers(lists.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const own of lists) {
    all.set(own, at);
    at += own.length;
  }
  return all;
}

/** Indices of vertices that follow others. */
function raised(indices: Uint32Array, by: number): Uint32Array {
  if (by === 0) return indices;
  const out = indices.slice();
  for (let i = 0; i < out.length; i++) out[i] += by;
  return out;
}

/** Normals, with those of vertices without one computed. */
function completed(normals: Float64Array, positions: Float64Array, triangles: Uint32Array): Float64Array {
  if (firstNotFinite(normals) < 0) return normals;
  const computed = computeNormals(positions, triangles);
  const out = normals.slice();
  for (let v = 0; v < out.length; v += 3) {
    const isWhole = Number.isFinite(out[v] + out[v + 1] + out[v + 2]);
    if (!isWhole) out.set(computed.subarray(v, v + 3), v);
  }
  return out;
}

function attachmentsOf(
  meshes: readonly SceneMesh[],
  binding: Binding,
  jointsOf: (bound: BoundMesh) => readonly number[],
  total: number,
): Attachments {
  const start = new Uint32Array(total + 1);
  const count = meshes.reduce(
    (sum, { skinned, positions }) => sum + (skinned ? skinned.attachments.joints.length : positions.length / 3),
    0,
  );
  const joints = new Uint32Array(count);
  const weights = new Float64Array(count);
  let vertex = 0;
  let at = 0;
  meshes.forEach(({ skinned, positions }, m) => {
    const slots = Uint32Array.from(jointsOf(binding.meshes[m]));
    const vertices = positions.length / 3;
    if (skinned) {
      const { start: itsStart, joints: itsJoints, weights: itsWeights } = skinned.attachments;
      for (let a = 0; a < itsJoints.length; a++) joints[at + a] = slots[itsJoints[a]];
      weights.set(itsWeights, at);
      for (let v = 1; v <= vertices; v++) start[vertex + v] = at + itsStart[v];
      at += itsJoints.length;
    } else {
      joints.fill(slots[0], at, at + vertices);
      weights.fill(1, at, at + vertices);
      for (let v = 1; v <= vertices; v++) start[vertex + v] = at + v;
      at += vertices;
    }
    vertex += vertices;
  });
  return { start, joints, weights };
}

function morphsOf(meshes: readonly SceneMesh[], binding: Binding) {
  const names = new DistinctNames();
  const morphs: Morph[] = [];
  const targets: (readonly [mesh: number, target: number, weight: number])[] = [];
  let first = 0;
  meshes.forEach((mesh, m) => {
    const { matrix } = binding.meshes[m];
    const rows = ({ indices, values }: MorphRows, w: 0 | 1): MorphRows => ({
      indices: raised(indices, first),
      values: movedBy(matrix, values, w),
    });
    mesh.targets.forEach((target, t) => {
      const called = cleanFileName(target.name) || `${cleanFileName(mesh.name) || 'morph'}_${t}`;
      const movesNothing = target.positions.indices.length === 0 && target.normals.indices.length === 0;
      // A `.morph` needs a vertex: the first one, where it is.
      const moved = movesNothing ? firstVertex(mesh) : target.positions;
      const { weight } = target;
      morphs.push({
        name: names.add(called),
        positions: rows(moved, 1),
        normals: rows(target.normals, 0),
        ...(weight !== 0 && { weight }),
      });
      targets.push([m, t, weight]);
    });
    first += mesh.positions.length / 3;
  });
  const weightsOf = ({ weights }: SceneTake): readonly Channel[] => {
    const curves = new Map(weights.map(({ mesh, target, curve }) => [`${mesh} ${target}`, curve]));
    return targets.map(([mesh, target, weight]) => curves.get(`${mesh} ${target}`) ?? restChannel(weight));
  };
  return { morphs, weightsOf };
}

/** The first vertex of a mesh; none if it has no vertices. */
function firstVertex({ positions }: SceneMesh): MorphRows {
  const values = positions.slice(0, 3);
  return { indices: new Uint32Array(values.length / 3), values };
}

function jointChannels(
  joints: readonly Joint[],
  slots: readonly Slot[],
  motions: readonly (JointMotion | undefined)[],
  moves: ReadonlyMap<number, SceneMove>,
): readonly (Channel | TrackedDof)[] {
  const root = carriesCharacter(joints[0].motion) ? [] : [restChannel(), restChannel(), restChannel()];
  return [...root, ...slots.flatMap(({ node }, j) => motions[j]?.channels(moves.get(node)) ?? [])];
}

function isChannel(channel: Channel | TrackedDof): channel is Channel {
  return channel.kind !== 'tracked';
}
