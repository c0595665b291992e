/**
 * Bounding boxes of a skin in any pose, computed from its joints without a loop over its vertices.
 *
 * A vertex with weights ≥ 0 that sum to s lies, on each axis, between the minimum and maximum of s · (W·B⁻¹)ⱼ · v over
 * its joints j. So, with boxⱼ around the vertices (in the skin's own space) that joint j moves, and [s₀, s₁] the range
 * of their sums:
 *
 *     posed ⊆ ∪ⱼ [s₀, s₁]ⱼ · (W·B⁻¹)ⱼ · boxⱼ
 *
 * - A vertex with a negative weight leaves that hull. Around the centre c of all moved boxes, with half size h, it is
 *   v′ = s·c + Σ w·(p − c), hence within [s₀, s₁]·c ± max Σ|w| · h over all such vertices.
 * - Vertices without attachments have a box of their own that no joint moves.
 * - Morphs widen boxⱼ by φ times the minimum and maximum displacement of its vertices, on each axis.
 *
 * The box is never too small, rounding included, and tight for joints that turn little. A box around the deformed
 * vertices would be tightest, but needs a loop over up to a million vertices per frame.
 */
import type { Morph } from '../../model/morph.ts';
import { perObject } from '../../model/per-object.ts';
import { type Skin, vertexCount } from '../../model/skin.ts';
import { matrixCountOf } from './deform.ts';
import { adoptNormals, normalsOf } from './normals.ts';

/** The precomputed data of a skin and its morphs for `posedBounds`. */
export interface SkinBounds {
  readonly joints: JointBoxes;
  /** One per morph. */
  readonly reaches: readonly MorphReach[];
}

/** The boxes of a skin's vertices by joint, from which its box in any pose is computed. */
export interface JointBoxes {
  /** Minimum x y z and maximum x y z, 6 per matrix, then 6 for the vertices without attachments; inverted if empty. */
  readonly boxes: Float64Array;
  /** Minimum and maximum sum of weights, 2 per matrix, then 2 for the vertices without attachments. */
  readonly weightSums: Float64Array;
  /** For vertices with a negative weight: maximum sum of |w|, minimum and maximum sum of w; all 0 if there are none. */
  readonly mixed: Float64Array;
}

/** How far a morph at weight 1 displaces the vertices of each joint that it affects. */
export interface MorphReach {
  /** Indices of boxes: joints, or one past them for vertices without attachments. */
  readonly boxes: Uint32Array;
  /** Minimum x y z (≤ 0) and maximum x y z (≥ 0), 6 for each of `boxes`. */
  readonly displacements: Float64Array;
}

/**
 * Everything that loops over all vertices of a skin, done once: plain data in a few large arrays, computed by a worker
 * and adopted by the page.
 */
export interface SkinFacts {
  readonly bounds: SkinBounds;
  /** Computed normals, if the skin has none of its own. */
  readonly normals?: Float64Array;
  readonly maxAttachments: number;
  /** Number of vertices that each joint moves. */
  readonly movedVertices: Uint32Array;
}

const factsOf = perObject(measure);
const reachesOf = perObject((skin: Skin) => perObject((morph: Morph) => measureReach(skin, morph)));
const boundsOf = new WeakMap<Skin, { readonly morphs: readonly Morph[]; readonly bounds: SkinBounds }>();

/** A skin's facts, cached. The bounds include these morphs. */
export function skinFacts(skin: Skin, morphs: readonly Morph[] = []): SkinFacts {
  const facts = factsOf(skin);
  return morphs.length ? { ...facts, bounds: skinBounds(skin, morphs) } : facts;
}

/**
 * Adopts facts computed elsewhere, for a skin that is a copy of the one they were computed from.
 * @param morphs copies of those passed to `skinFacts`, in the same order
 */
export function adoptSkinFacts(skin: Skin, facts: SkinFacts, morphs: readonly Morph[] = []): void {
  factsOf.adopt(skin, { ...facts, bounds: { joints: facts.bounds.joints, reaches: [] } });
  if (facts.normals) adoptNormals(skin, facts.normals);
  const known = reachesOf(skin);
  morphs.forEach((morph, m) => {
    const reach = facts.bounds.reaches[m];
    if (reach) known.adopt(morph, reach);
  });
}

/** A skin's bounds with these morphs, for `posedBounds`; cached. */
export function skinBounds(skin: Skin, morphs: readonly Morph[] = []): SkinBounds {
  const cached = boundsOf.get(skin);
  if (cached && cached.morphs.length === morphs.length && cached.morphs.every((m, i) => m === morphs[i])) {
    return cached.bounds;
  }
  const reaches = morphs.map(reachesOf(skin));
  const bounds = { joints: skinFacts(skin).bounds.joints, reaches };
  boundsOf.set(skin, { morphs, bounds });
  return bounds;
}

/** Scratch of `posedBounds`; grows to the largest skin. */
let widened = new Float64Array(0);

/**
 * A box around the whole skin in a pose: minimum x y z and maximum x y z, in the character's space.
 * @param matrices W·B⁻¹ from `skinMatrices`; undefined if the skin is not deformed
 * @param weights the weight of morph m is `weights[weightOffset + m]`
 * @param out 6 numbers; inverted (minimum above maximum) for a skin without vertices
 */
export function posedBounds(
  bounds: SkinBounds,
  matrices: Float64Array | undefined,
  weights: Float64Array,
  weightOffset: number,
  out: Float64Array,
): void {
  const { boxes, weightSums, mixed } = bounds.joints;
  if (widened.length < boxes.length) widened = new Float64Array(boxes.length);
  widened.set(boxes);
  for (let m = 0; m < bounds.reaches.length; m++) widen(bounds.reaches[m], weights[weightOffset + m]);

  const last = boxes.length / 6 - 1;
  setEmpty(out);
  setEmpty(hull);
  for (let j = 0; j <= last; j++) {
    if (!(widened[6 * j] <= widened[6 * j + 3])) continue;
    if (matrices && j < last) {
      moveBox(matrices, 16 * j, widened, 6 * j, moved);
      include(hull, moved, 1, 1);
      include(out, moved, weightSums[2 * j], weightSums[2 * j + 1]);
    } else {
      for (let i = 0; i < 6; i++) moved[i] = widened[6 * j + i];
      include(out, moved, 1, 1);
    }
  }
  if (!matrices || mixed[0] === 0) return;
  for (let i = 0; i < 3; i++) {
    const centre = (hull[i] + hull[i + 3]) / 2;
    const half = mixed[0] * ((hull[i + 3] - hull[i]) / 2) * (1 + ROUNDING);
    out[i] = Math.min(out[i], Math.min(mixed[1] * centre, mixed[2] * centre) - half);
    out[i + 3] = Math.max(out[i + 3], Math.max(mixed[1] * centre, mixed[2] * centre) + half);
  }
}

/** Scratch: a box moved by a joint, and the box around all of them. */
const moved = new Float64Array(6);
const hull = new Float64Array(6);

/** Rounding error of a sum of a few dozen terms, relative to the largest; boxes are widened by it. */
const ROUNDING = 1e-14;

function setEmpty(box: Float64Array): void {
  box[0] = box[1] = box[2] = Infinity;
  box[3] = box[4] = box[5] = -Infinity;
}

function widen({ boxes, displacements }: MorphReach, weight: number): void {
  if (weight === 0) return;
  // A negative weight reverses the displacements.
  const least = weight > 0 ? 0 : 3;
  const greatest = 3 - least;
  for (let b = 0; b < boxes.length; b++) {
    for (let i = 0; i < 3; i++) {
      const low = 6 * boxes[b] + i;
      const high = low + 3;
      const down = weight * displacements[6 * b + least + i];
      const up = weight * displacements[6 * b + greatest + i];
      const rounding = ROUNDING * (Math.abs(widened[low]) + Math.abs(widened[high]) + up - down);
      widened[low] += down - rounding;
      widened[high] += up + rounding;
    }
  }
}

/**
 * The box around a box transformed by a matrix (J. Arvo, "Transforming axis-aligned bounding boxes", Graphics Gems
 * 1990).
 */
function moveBox(m: Float64Array, mo: number, box: Float64Array, bo: number, out: Float64Array): void {
  const cx = (box[bo] + box[bo + 3]) / 2;
  const cy = (box[bo + 1] + box[bo + 4]) / 2;
  const cz = (box[bo + 2] + box[bo + 5]) / 2;
  const hx = box[bo + 3] - cx;
  const hy = box[bo + 4] - cy;
  const hz = box[bo + 5] - cz;
  for (let r = 0; r < 3; r++) {
    const x = m[mo + r];
    const y = m[mo + 4 + r];
    const z = m[mo + 8 + r];
    const t = m[mo + 12 + r];
    const centre = x * cx + y * cy + z * cz + t;
    const half = Math.abs(x) * hx + Math.abs(y) * hy + Math.abs(z) * hz;
    const largest = Math.abs(x * cx) + Math.abs(y * cy) + Math.abs(z * cz) + half + Math.abs(t);
    out[r] = centre - half - ROUNDING * largest;
    out[r + 3] = centre + half + ROUNDING * largest;
  }
}

/** Extends `out` to contain `box` scaled by any factor from `s0` to `s1`, both ≥ 0. */
function include(out: Float64Array, box: Float64Array, s0: number, s1: number): void {
  for (let i = 0; i < 3; i++) {
    out[i] = Math.min(out[i], s0 * box[i], s1 * box[i]);
    out[i + 3] = Math.max(out[i + 3], s0 * box[i + 3], s1 * box[i + 3]);
  }
}

/** The box around undeformed vertices: minimum x y z and maximum x y z; inverted if there are none. */
export function boxOf(positions: Float64Array, out: Float64Array): void {
  setEmpty(out);
  for (let o = 0; o < positions.length; o += 3) {
    for (let i = 0; i < 3; i++) {
      const x = positions[o + i];
      if (x < out[i]) out[i] = x;
      if (x > out[i + 3]) out[i + 3] = x;
    }
  }
}

/**
 * A vertex belongs to the boxes of joints it is attached to with a weight other than 0, or to those of all its joints
 * if all weights are 0, which pulls it to the origin.
 */
function measure(skin: Skin): SkinFacts {
  const { positions, attachments } = skin;
  const vertices = vertexCount(skin);
  const joints = matrixCountOf(skin);
  const boxes = new Float64Array(6 * (joints + 1));
  const weightSums = new Float64Array(2 * (joints + 1));
  const mixed = new Float64Array(3);
  const movedVertices = new Uint32Array(joints);
  let maxAttachments = 0;
  for (let j = 0; j <= joints; j++) {
    boxes.fill(Infinity, 6 * j, 6 * j + 3);
    boxes.fill(-Infinity, 6 * j + 3, 6 * j + 6);
    weightSums[2 * j] = Infinity;
    weightSums[2 * j + 1] = -Infinity;
  }
  if (!attachments) {
    for (let v = 0; v < vertices; v++) grow(boxes, 0, positions, 3 * v);
    weightSums[0] = weightSums[1] = 1;
    movedVertices[0] = vertices;
  } else {
    const { start, joints: jointOf, weights } = attachments;
    // Counts a vertex once even if it is attached to one joint twice.
    const lastCounted = new Int32Array(joints).fill(-1);
    for (let v = 0; v < vertices; v++) {
      const from = start[v];
      const to = start[v + 1];
      if (to - from > maxAttachments) maxAttachments = to - from;
      if (from === to) {
        grow(boxes, joints, positions, 3 * v);
        continue;
      }
      let sum = 0;
      let size = 0;
      let plain = true;
      for (let a = from; a < to; a++) {
        sum += weights[a];
        size += Math.abs(weights[a]);
        if (weights[a] < 0) plain = false;
      }
      if (!plain) {
        mixed[1] = mixed[0] === 0 ? sum : Math.min(mixed[1], sum);
        mixed[2] = mixed[0] === 0 ? sum : Math.max(mixed[2], sum);
        mixed[0] = Math.max(mixed[0], size);
      }
      for (let a = from; a < to; a++) {
        if (weights[a] === 0 && size > 0) continue;
        const j = jointOf[a];
        grow(boxes, j, positions, 3 * v);
        if (plain) {
          if (sum < weightSums[2 * j]) weightSums[2 * j] = sum;
          if (sum > weightSums[2 * j + 1]) weightSums[2 * j + 1] = sum;
        }
        if (weights[a] !== 0 && lastCounted[j] !== v) {
          lastCounted[j] = v;
          movedVertices[j]++;
        }
      }
    }
    // A joint without ordinary vertices: its box only serves the hull.
    for (let j = 0; j <= joints; j++)
      if (!(weightSums[2 * j] <= weightSums[2 * j + 1])) weightSums.fill(1, 2 * j, 2 * j + 2);
  }
  const facts = { bounds: { joints: { boxes, weightSums, mixed }, reaches: [] }, maxAttachments, movedVertices };
  return skin.normals ? facts : { ...facts, normals: normalsOf(skin) };
}

function grow(boxes: Float64Array, box: number, positions: Float64Array, o: number): void {
  const b = 6 * box;
  const x = positions[o];
  const y = positions[o + 1];
  const z = positions[o + 2];
  if (x < boxes[b]) boxes[b] = x;
  if (y < boxes[b + 1]) boxes[b + 1] = y;
  if (z < boxes[b + 2]) boxes[b + 2] = z;
  if (x > boxes[b + 3]) boxes[b + 3] = x;
  if (y > boxes[b + 4]) boxes[b + 4] = y;
  if (z > boxes[b + 5]) boxes[b + 5] = z;
}

function measureReach(skin: Skin, morph: Morph): MorphReach {
  const { attachments } = skin;
  const { indices } = morph.positions;
  const vertices = vertexCount(skin);
  const joints = matrixCountOf(skin);
  const moved = displacementsOf(skin, morph);
  const all = new Float64Array(6 * (joints + 1));
  const touched = new Uint8Array(joints + 1);
  for (let row = 0; row < indices.length; row++) {
    const v = indices[row];
    if (v >= vertices) continue;
    const from = attachments ? attachments.start[v] : 0;
    const to = attachments ? attachments.start[v + 1] : 0;
    if (from === to) stretch(all, touched, attachments ? joints : 0, moved, 3 * row);
    for (let a = from; a < to; a++) if (attachments) stretch(all, touched, attachments.joints[a], moved, 3 * row);
  }
  const boxes = Uint32Array.from(touched.keys()).filter((j) => touched[j]);
  const displacements = new Float64Array(6 * boxes.length);
  boxes.forEach((j, b) => {
    displacements.set(all.subarray(6 * j, 6 * j + 6), 6 * b);
  });
  return { boxes, displacements };
}

/** x y z per row of the morph, at weight 1. If several rows move one vertex, the first has the sum. */
function displacementsOf(skin: Skin, { positions: { indices, values } }: Morph): Float64Array {
  const moved = new Float64Array(values.length);
  let ascending = true;
  for (let row = 0; row < indices.length; row++) {
    if (row > 0 && indices[row] <= indices[row - 1]) ascending = false;
    for (let i = 0; i < 3; i++) moved[3 * row + i] = values[3 * row + i] - skin.positions[3 * indices[row] + i];
  }
  if (ascending) return moved;
  const firstRow = new Map<number, number>();
  for (let row = 0; row < indices.length; row++) {
    const first = firstRow.get(indices[row]);
    if (first === undefined) firstRow.set(indices[row], row);
    else {
      for (let i = 0; i < 3; i++) {
        moved[3 * first + i] += moved[3 * row + i];
        moved[3 * row + i] = 0;
      }
    }
  }
  return moved;
}

/** Extends a joint's displacements, which always include 0, by one more. */
function stretch(all: Float64Array, touched: Uint8Array, j: number, moved: Float64Array, at: number): void {
  touched[j] = 1;
  for (let i = 0; i < 3; i++) {
    const d = moved[at + i];
    if (d < all[6 * j + i]) all[6 * j + i] = d;
    else if (d > all[6 * j + 3 + i]) all[6 * j + 3 + i] = d;
  }
}
