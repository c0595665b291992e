/**
 * Collects the joints with the largest weights of each vertex, one joint after another, and makes a skin's attachments
 * of them.
 */

import type { Attachments } from '../../model/skin.ts';
import type { Steps } from '../steps.ts';

/** Smaller fractions of a vertex's weight have no visible effect, and only take space in the file. */
const MIN_FRACTION = 0.004;
/** Weights are written with this precision. */
const SCALE = 1e4;
/** Vertices between two yields. */
const A_STEP = 5000;

/** The heaviest `most` joints of each vertex so far. */
export class Influences {
  /** `most` per vertex, heaviest first; unused ones have weight 0. */
  private readonly joints: Uint32Array;
  private readonly weights: Float64Array;

  constructor(
    vertexCount: number,
    private readonly most: number,
  ) {
    this.joints = new Uint32Array(vertexCount * most);
    this.weights = new Float64Array(vertexCount * most);
  }

  /** Each joint at most once. */
  add(vertex: number, joint: number, weight: number): void {
    const { joints, weights, most } = this;
    const from = vertex * most;
    let at = from + most - 1;
    if (!(weight > weights[at])) return;
    for (; at > from && weights[at - 1] < weight; at--) {
      weights[at] = weights[at - 1];
      joints[at] = joints[at - 1];
    }
    weights[at] = weight;
    joints[at] = joint;
  }

  /** Whether a vertex has a weight greater than 0. */
  has(vertex: number): boolean {
    return this.weights[vertex * this.most] > 0;
  }

  /**
   * Weights that sum to 1, in ten-thousandths; the heaviest takes the rounding error. Joints ascend at each vertex.
   * Yields its progress every few milliseconds.
   * @param of for each vertex of the skin, its vertex here
   */
  *attachments(of: Uint32Array): Steps<Attachments> {
    const start = new Uint32Array(of.length + 1);
    const joints = new Uint32Array(of.length * this.most);
    const weights = new Float64Array(of.length * this.most);
    const parts = new Float64Array(this.most);
    let end = 0;
    for (let v = 0; v < of.length; v++) {
      if (v % A_STEP === 0) yield v / of.length;
      const from = of[v] * this.most;
      const count = this.rounded(from, parts);
      for (let i = 0; i < count; i++) {
        if (parts[i] <= 0) continue;
        let at = end++;
        for (; at > start[v] && joints[at - 1] > this.joints[from + i]; at--) {
          joints[at] = joints[at - 1];
          weights[at] = weights[at - 1];
        }
        joints[at] = this.joints[from + i];
        weights[at] = parts[i] / SCALE;
      }
      start[v + 1] = end;
    }
    return { start, joints: joints.slice(0, end), weights: weights.slice(0, end) };
  }

  /** Integers that sum to `SCALE`, heaviest first. @returns their number */
  private rounded(from: number, parts: Float64Array): number {
    const { weights, most } = this;
    let all = 0;
    for (let i = 0; i < most; i++) all += weights[from + i];
    let kept = 0;
    let count = 0;
    while (count < most && weights[from + count] >= MIN_FRACTION * all && weights[from + count] > 0) {
      kept += weights[from + count++];
    }
    let left = SCALE;
    for (let i = 0; i < count; i++) {
      parts[i] = Math.round((SCALE * weights[from + i]) / kept);
      left -= parts[i];
    }
    if (count > 0) parts[0] += left;
    return count;
  }
}
