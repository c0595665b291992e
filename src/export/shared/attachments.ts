/**
 * The attachments of a skin's vertices as glTF has them: sets of four joints and weights, the strongest first, weights
 * normalised so that they sum to 1 as floats too.
 */
import { type Skin, vertexCount } from '../../model/skin.ts';

/** The attachments of all vertices in sets of four, with what had to be changed. */
export interface AttachmentSets {
  /** Four per vertex and set, one array per set. */
  readonly joints: readonly (Uint8Array<ArrayBuffer> | Uint16Array<ArrayBuffer>)[];
  readonly weights: readonly Float32Array<ArrayBuffer>[];
  /** Attachments per vertex before any were left out; at least 1. */
  readonly most: number;
  /** Whether a vertex is moved otherwise than by its own weights. */
  readonly isTrimmed: boolean;
  readonly isRescaled: boolean;
  /** Whether a vertex hangs on the joint that never moves. */
  readonly hasStatic: boolean;
}

/** Weights whose sum is this far off 1 are told. */
const SUM_OFF = 0.01;

/**
 * The attachments of a skin in sets of four.
 * @param jointCount joints of the skeleton
 * @param resting the index of a joint that never moves, for vertices without attachments
 * @param influences keep only so many, the strongest
 */
export function attachmentSets(
  skin: Skin,
  jointCount: number,
  resting: number,
  influences = Number.POSITIVE_INFINITY,
): AttachmentSets {
  const vertices = vertexCount(skin);
  let most = 1;
  let isRescaled = false;
  // Twice through, since a million lists would take more memory than the file.
  for (let v = 0; v < vertices; v++) {
    const one = strongest(skin, jointCount, resting, v);
    most = Math.max(most, one.all.length);
    isRescaled ||= one.isRescaled;
  }
  const kept = Math.min(most, influences);
  const sets = Math.ceil(kept / 4);
  const isSmall = resting < 256;
  const joints = Array.from({ length: sets }, () =>
    isSmall ? new Uint8Array(4 * vertices) : new Uint16Array(4 * vertices),
  );
  const weights = Array.from({ length: sets }, () => new Float32Array(4 * vertices));
  let hasStatic = false;
  for (let v = 0; v < vertices; v++) {
    const few = strongest(skin, jointCount, resting, v).all.slice(0, kept);
    const sum = few.reduce((total, { weight }) => total + weight, 0);
    let rest = 1;
    few.forEach(({ joint, weight }, a) => {
      if (joint === resting) hasStatic = true;
      const part = Math.fround(weight / sum);
      joints[a >> 2][4 * v + (a & 3)] = joint;
      weights[a >> 2][4 * v + (a & 3)] = part;
      rest -= part;
    });
    // Rounding goes to the strongest.
    weights[0][4 * v] = Math.fround(weights[0][4 * v] + rest);
  }
  return {
    joints,
    weights,
    most,
    isTrimmed: most > kept,
    isRescaled,
    hasStatic,
  };
}

interface Attachment {
  readonly joint: number;
  readonly weight: number;
}

/** The attachments of a vertex, the strongest first; each joint once, weights greater than 0. */
function strongest(
  { attachments }: Skin,
  jointCount: number,
  resting: number,
  v: number,
): { readonly all: readonly Attachment[]; readonly isRescaled: boolean } {
  if (!attachments) return { all: [{ joint: 0, weight: 1 }], isRescaled: false };
  const { start, joints, weights } = attachments;
  const byJoint = new Map<number, number>();
  for (let a = start[v]; a < start[v + 1]; a++) {
    const joint = joints[a] < jointCount ? joints[a] : resting;
    byJoint.set(joint, (byJoint.get(joint) ?? 0) + weights[a]);
  }
  if (byJoint.size === 0) return { all: [{ joint: resting, weight: 1 }], isRescaled: false };
  let sum = 0;
  for (const weight of byJoint.values()) sum += weight;
  const all = [...byJoint]
    .map(([joint, weight]) => ({ joint, weight }))
    // What is 0 as a float would be an attachment of weight 0, which files may not have.
    .filter(({ weight }) => weight > 0 && Math.fround(weight / sum) > LEAST)
    .sort((a, b) => b.weight - a.weight || a.joint - b.joint);
  if (all.length === 0) return { all: [{ joint: resting, weight: 1 }], isRescaled: true };
  return { all, isRescaled: Math.abs(sum - 1) > SUM_OFF };
}

/** Weights below this are left out: they move nothing by a millionth. */
const LEAST = 1e-7;
