/**
 * One binding for each joint, out of many skins. A `.skin` has one binding per joint, while other programs have one per
 * joint and skin:
 *
 *     v′ = Σ w · W · IBM · v          theirs, IBM of the mesh's skin
 *     v′ = Σ w · W · B⁻¹ · (A·v)      ours
 *
 * The vertices of a mesh are moved by A where that makes B⁻¹·A the IBM for all of its joints. Where none does, the
 * joints that disagree get a further joint below them, which doesn't move and has the other binding.
 */
import { invertAffine, isSingular, multiplyAffine, setIdentity } from '../math/mat4.ts';
import { NOISE } from './noise.ts';
import type { SceneMesh } from './scene.ts';

/** The one binding of each joint, and how the meshes are moved for it. */
export interface Binding {
  /** B⁻¹ of each node that has one. */
  readonly inverse: ReadonlyMap<number, Float64Array>;
  readonly further: readonly FurtherJoint[];
  /** Bindings of the meshes. */
  readonly meshes: readonly BoundMesh[];
}

/** A joint that is added for a binding that its node can't have; 16 numbers. */
export interface FurtherJoint {
  /** The node below which it is. */
  readonly node: number;
  readonly inverse: Float64Array;
}

/** How a mesh is moved and attached. */
export interface BoundMesh {
  /** Moves its vertices; absent: identity. */
  readonly matrix?: Float64Array;
  /** For each joint of its skin, or for its node: a node, or −1 − the index of a further joint. */
  readonly joints: readonly number[];
}

/**
 * Finds one binding for each joint, and a matrix for each mesh.
 * @param worlds of nodes at rest, 16 numbers each
 */
export function bindMeshes(meshes: readonly SceneMesh[], worlds: Float64Array): Binding {
  const inverse = new Map<number, Float64Array>();
  const further: FurtherJoint[] = [];
  const bound = meshes.map((mesh) => {
    const { joints, inverseBinds } = usedJoints(mesh);
    if (!mesh.skinned && !inverse.has(mesh.node)) {
      // Its vertices in the space of the character at rest, as those of skins mostly are.
      const world = worlds.slice(16 * mesh.node, 16 * mesh.node + 16);
      if (!isSingular(world)) inverse.set(mesh.node, inverted(world));
    }
    const used = joints.flatMap((node, j) => (node >= 0 ? [j] : []));
    const matrix = commonMatrix(joints, inverseBinds, used, inverse);
    const isMoved = matrix !== undefined && !isNear(matrix, identity(), 1);
    const undo = matrix && isMoved ? inverted(matrix) : undefined;
    const slots = joints.map((node, j) => {
      if (node < 0) return 0;
      const own = inverseBinds.subarray(16 * j, 16 * j + 16);
      const known = inverse.get(node);
      if (!known) {
        inverse.set(node, undo ? product(own, undo) : own.slice());
        return node;
      }
      if (matrix || isNear(known, own, lengthOf(own))) return node;
      let at = further.findIndex((joint) => joint.node === node && isNear(joint.inverse, own, lengthOf(own)));
      if (at < 0) at = further.push({ node, inverse: own.slice() }) - 1;
      return -1 - at;
    });
    return { joints: slots, ...(matrix && isMoved && { matrix }) };
  });
  return { inverse, further, meshes: bound };
}

/** The nodes that the mesh's vertices are attached to (-1: a joint of its skin without vertices), and their IBMs. */
function usedJoints({ node, skinned }: SceneMesh) {
  if (!skinned) return { joints: [node], inverseBinds: identity() };
  const { skin, attachments } = skinned;
  const isUsed = new Uint8Array(skin.joints.length);
  const { joints: attached } = attachments;
  for (let a = 0; a < attached.length; a++) isUsed[attached[a]] = 1;
  const inverseBinds = skin.inverseBinds.slice();
  for (let j = 0; j < isUsed.length; j++) if (isUsed[j]) makeInvertible(inverseBinds, 16 * j);
  return { joints: skin.joints.map((joint, j) => (isUsed[j] ? joint : -1)), inverseBinds };
}

/** A matrix A with B⁻¹·A = IBM for all joints that are bound; undefined if there is none. */
function commonMatrix(
  joints: readonly number[],
  inverseBinds: Float64Array,
  used: readonly number[],
  bound: ReadonlyMap<number, Float64Array>,
): Float64Array | undefined {
  let common: Float64Array | undefined;
  for (const j of used) {
    const known = bound.get(joints[j]);
    if (!known) continue;
    const own = inverseBinds.subarray(16 * j, 16 * j + 16);
    const size = Math.max(lengthOf(own), lengthOf(known));
    if (!common) {
      common = isNear(known, own, size) ? identity() : product(inverted(known), own);
      if (isSingular(common)) return undefined;
    } else if (!isNear(product(known, common), own, size)) return undefined;
  }
  return common ?? identity();
}

/** A joint that flattens can't be bound, so that its vertices keep a millionth of their thickness. */
function makeInvertible(m: Float64Array, o: number): void {
  if (!isSingular(m, o)) return;
  const lengths = [0, 4, 8].map((c) => Math.hypot(m[o + c], m[o + c + 1], m[o + c + 2]));
  const tiny = 1e-6 * Math.max(...lengths, 1e-6);
  for (let c = 0; c < 3 && isSingular(m, o); c++) {
    if (lengths[c] > 1e-9 * Math.max(...lengths)) continue;
    const [a, b] = [4 * ((c + 1) % 3), 4 * ((c + 2) % 3)];
    const across = [0, 1, 2].map(
      (r) => m[o + a + ((r + 1) % 3)] * m[o + b + ((r + 2) % 3)] - m[o + a + ((r + 2) % 3)] * m[o + b + ((r + 1) % 3)],
    );
    const length = Math.hypot(...across);
    for (let r = 0; r < 3; r++) m[o + 4 * c + r] = length > 0 ? (tiny * across[r]) / length : r === c ? tiny : 0;
  }
  for (let n = 0; n < 3 && isSingular(m, o); n++) for (let k = 0; k < 3; k++) m[o + 5 * k] += tiny * (n + k + 1);
}

/** Whether matrices agree up to the noise of single precision. @param size of their coordinates */
function isNear(a: Float64Array, b: Float64Array, size: number): boolean {
  for (let i = 0; i < 16; i++) {
    const scale =
      i < 12 ? Math.max(1e-9, Math.hypot(a[i & ~3], a[(i & ~3) + 1], a[(i & ~3) + 2])) : Math.max(size, 1e-9);
    if (!(Math.abs(a[i] - b[i]) <= NOISE * scale)) return false;
  }
  return true;
}

function lengthOf(m: Float64Array): number {
  return Math.hypot(m[12], m[13], m[14]);
}

function identity(): Float64Array {
  const m = new Float64Array(16);
  setIdentity(m);
  return m;
}

/** The inverse of an affine matrix of 16 numbers, as a new array. */
export function inverted(m: Float64Array): Float64Array {
  const out = new Float64Array(16);
  invertAffine(m, 0, out, 0);
  return out;
}

/** a · b of affine matrices of 16 numbers, as a new array. */
export function product(a: Float64Array, b: Float64Array): Float64Array {
  const out = new Float64Array(16);
  multiplyAffine(a, 0, b, 0, out, 0);
  return out;
}
