/**
 * The nodes that show a skeleton's joints in glTF, whose nodes have a translation, a rotation and a scale each:
 *
 *     local matrix of a node = T · R · S
 *
 * A joint that neither stretches nor shears is one node. Any other is a chain of nodes, each the parent of the next,
 * whose product is the joint's matrix; children of the joint hang below the last one.
 */
import type { CompiledSkeleton } from '../../evaluate/kinematics.ts';
import { localMatrices } from '../../evaluate/kinematics.ts';
import type { MotionPart } from '../../evaluate/motions/motion.ts';
import { quaternionOfRotation } from '../../math/quaternion.ts';

/** Numbers of a node in a row: translation x y z, rotation x y z w, scale x y z. */
export const NODE_WIDTH = 10;
/** Where they are. */
export const ROTATION = 3;
/** Where a node's scale begins among its numbers. */
export const SCALE = 7;

/** A node of a joint's chain. */
export interface JointNode {
  readonly joint: number;
  /** Index of the parent among the nodes, smaller than its own; -1 for the root's first. */
  readonly parent: number;
  /** Position in the joint's chain, from 0. */
  readonly place: number;
  /** Which of its numbers may change: translation, rotation, scale. */
  readonly hasScale: boolean;
  /** The parts that are multiplied, from left to right; absent: the joint's matrix, which is T · R. */
  readonly parts?: readonly MotionPart[];
}

/** The nodes of all joints. */
export interface JointNodes {
  readonly nodes: readonly JointNode[];
  /** The last node of each joint. */
  readonly lastOf: Int32Array;
}

/** The nodes of a skeleton, in depth-first order of its joints. */
export function jointNodes(skeleton: CompiledSkeleton): JointNodes {
  const nodes: JointNode[] = [];
  const lastOf = new Int32Array(skeleton.jointCount);
  for (let joint = 0; joint < skeleton.jointCount; joint++) {
    const above = skeleton.parent[joint];
    let parent = above < 0 ? -1 : lastOf[above];
    const { parts } = skeleton.motions[joint];
    const chain = parts ? groups(parts) : [undefined];
    chain.forEach((group, place) => {
      const hasScale = group?.some(({ kind }) => kind === 'scale') ?? false;
      nodes.push({ joint, parent, place, hasScale, ...(group && { parts: group }) });
      parent = nodes.length - 1;
    });
    lastOf[joint] = parent;
  }
  return { nodes, lastOf };
}

const STAGES = ['translation', 'rotation', 'scale'] as const;

/** As few runs as possible in which no rotation is before a translation, and no scale before either. */
function groups(parts: readonly MotionPart[]): readonly (readonly MotionPart[])[] {
  const all: MotionPart[][] = [[]];
  let reached = 0;
  for (const part of parts) {
    const stage = STAGES.indexOf(part.kind);
    if (stage < reached) all.push([]);
    reached = stage;
    all[all.length - 1].push(part);
  }
  return all;
}

/** Writes a pose as a row: `NODE_WIDTH` numbers for each node. Allocates nothing. */
export type WriteNodes = (dofs: Float64Array, out: Float64Array, o: number) => void;

/**
 * Makes a function that writes the translation, rotation and scale of all nodes for a row of DOFs, `NODE_WIDTH` numbers
 * each.
 */
export function nodeWriter(skeleton: CompiledSkeleton, { nodes }: JointNodes): WriteNodes {
  const local = new Float64Array(16 * skeleton.jointCount);
  const nine = new Float64Array(9);
  const q = new Float64Array(4);
  return (dofs, out, o) => {
    localMatrices(skeleton, dofs, local);
    for (let n = 0; n < nodes.length; n++) {
      const at = o + NODE_WIDTH * n;
      const { joint, parts, place } = nodes[n];
      const m = 16 * joint;
      setRest(out, at);
      if (!parts) {
        for (let k = 0; k < 3; k++) {
          out[at + k] = local[m + 12 + k];
          for (let r = 0; r < 3; r++) nine[3 * k + r] = local[m + 4 * k + r];
        }
        quaternionOfRotation(nine, 0, q);
        for (let k = 0; k < 4; k++) out[at + ROTATION + k] = q[k];
      } else {
        if (place === 0) writeStart(skeleton, joint, dofs, out, at);
        for (let p = 0; p < parts.length; p++) multiply(parts[p], dofs, skeleton.firstDof[joint], out, at, q);
      }
    }
  };
}

function setRest(out: Float64Array, o: number): void {
  out.fill(0, o, o + SCALE);
  out[o + ROTATION + 3] = 1;
  out.fill(1, o + SCALE, o + NODE_WIDTH);
}

/** T(offset), of the root with its translation: what is before the joint's own matrix. */
function writeStart(skeleton: CompiledSkeleton, joint: number, dofs: Float64Array, out: Float64Array, o: number): void {
  const moves = skeleton.parent[joint] < 0 && skeleton.hasRootTranslation;
  for (let k = 0; k < 3; k++) out[o + k] = skeleton.offsets[3 * joint + k] + (moves ? dofs[k] : 0);
}

function multiply(
  part: MotionPart,
  dofs: Float64Array,
  first: number,
  out: Float64Array,
  o: number,
  scratch: Float64Array,
): void {
  part.write(dofs, first, scratch);
  if (part.kind === 'translation') for (let k = 0; k < 3; k++) out[o + k] += scratch[k];
  else if (part.kind === 'scale') for (let k = 0; k < 3; k++) out[o + SCALE + k] *= scratch[k];
  else multiplyRotation(out, o + ROTATION, scratch);
}

/** a ← a · b, for quaternions x y z w. */
function multiplyRotation(a: Float64Array, o: number, [bx, by, bz, bw]: Float64Array): void {
  const x = a[o];
  const y = a[o + 1];
  const z = a[o + 2];
  const w = a[o + 3];
  a[o] = w * bx + x * bw + y * bz - z * by;
  a[o + 1] = w * by - x * bz + y * bw + z * bx;
  a[o + 2] = w * bz + x * by - y * bx + z * bw;
  a[o + 3] = w * bw - x * bx - y * by - z * bz;
}

/** Makes each rotation of a row the nearer of q and −q to that of the row before: components change steadily. */
export function keepNear(rows: Float64Array, before: number, o: number, nodeCount: number): void {
  for (let n = 0; n < nodeCount; n++) {
    const p = before + NODE_WIDTH * n + ROTATION;
    const q = o + NODE_WIDTH * n + ROTATION;
    const dot = rows[p] * rows[q] + rows[p + 1] * rows[q + 1] + rows[p + 2] * rows[q + 2] + rows[p + 3] * rows[q + 3];
    if (dot < 0) for (let k = 0; k < 4; k++) rows[q + k] = -rows[q + k];
  }
}

/** Nodes from `first` up to (excluding) `end`. */
export interface NodeRange {
  readonly first: number;
  readonly end: number;
}

/** Each node with all below it. */
export function subtrees(nodes: readonly JointNode[]): readonly NodeRange[] {
  const ends = nodes.map((_, n) => n + 1);
  for (let n = nodes.length - 1; n >= 0; n--) {
    const { parent } = nodes[n];
    if (parent >= 0) ends[parent] = Math.max(ends[parent], ends[n]);
  }
  return ends.map((end, first) => ({ first, end }));
}

/**
 * World matrices of nodes from a row, 16 numbers each, before any placement; those above `first` are there already.
 * @param o of the row
 * @param to where the matrix of node 0 is in `out`
 */
export function nodeWorlds(
  nodes: readonly JointNode[],
  row: Float64Array,
  o: number,
  out: Float64Array,
  to = 0,
  first = 0,
  end = nodes.length,
): void {
  for (let n = first; n < end; n++) {
    const at = o + NODE_WIDTH * n;
    const x = row[at + 3];
    const y = row[at + 4];
    const z = row[at + 5];
    const w = row[at + 6];
    const sx = row[at + 7];
    const sy = row[at + 8];
    const sz = row[at + 9];
    const l0 = (1 - 2 * (y * y + z * z)) * sx;
    const l1 = 2 * (x * y + w * z) * sx;
    const l2 = 2 * (x * z - w * y) * sx;
    const l4 = 2 * (x * y - w * z) * sy;
    const l5 = (1 - 2 * (x * x + z * z)) * sy;
    const l6 = 2 * (y * z + w * x) * sy;
    const l8 = 2 * (x * z + w * y) * sz;
    const l9 = 2 * (y * z - w * x) * sz;
    const l10 = (1 - 2 * (x * x + y * y)) * sz;
    const tx = row[at];
    const ty = row[at + 1];
    const tz = row[at + 2];
    const i = to + 16 * n;
    out[i + 3] = out[i + 7] = out[i + 11] = 0;
    out[i + 15] = 1;
    const { parent } = nodes[n];
    if (parent < 0) {
      out[i] = l0;
      out[i + 1] = l1;
      out[i + 2] = l2;
      out[i + 4] = l4;
      out[i + 5] = l5;
      out[i + 6] = l6;
      out[i + 8] = l8;
      out[i + 9] = l9;
      out[i + 10] = l10;
      out[i + 12] = tx;
      out[i + 13] = ty;
      out[i + 14] = tz;
      continue;
    }
    const p = to + 16 * parent;
    const a0 = out[p + 0];
    const b0 = out[p + 4];
    const c0 = out[p + 8];
    out[i + 0] = a0 * l0 + b0 * l1 + c0 * l2;
    out[i + 4] = a0 * l4 + b0 * l5 + c0 * l6;
    out[i + 8] = a0 * l8 + b0 * l9 + c0 * l10;
    out[i + 12] = a0 * tx + b0 * ty + c0 * tz + out[p + 12];
    const a1 = out[p + 1];
    const b1 = out[p + 5];
    const c1 = out[p + 9];
    out[i + 1] = a1 * l0 + b1 * l1 + c1 * l2;
    out[i + 5] = a1 * l4 + b1 * l5 + c1 * l6;
    out[i + 9] = a1 * l8 + b1 * l9 + c1 * l10;
    out[i + 13] = a1 * tx + b1 * ty + c1 * tz + out[p + 13];
    const a2 = out[p + 2];
    const b2 = out[p + 6];
    const c2 = out[p + 10];
    out[i + 2] = a2 * l0 + b2 * l1 + c2 * l2;
    out[i + 6] = a2 * l4 + b2 * l5 + c2 * l6;
    out[i + 10] = a2 * l8 + b2 * l9 + c2 * l10;
    out[i + 14] = a2 * tx + b2 * ty + c2 * tz + out[p + 14];
  }
}
