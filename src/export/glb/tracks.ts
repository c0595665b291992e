/** Properties of a character that move in a take, and how far an error of it is seen. */

import { type JointNode, NODE_WIDTH, ROTATION, SCALE } from '../shared/joint-nodes.ts';
import { pointOfPair, type Watch } from './fit/watch.ts';

/** One property of one node, or all morph weights: a channel of an animation. */
export interface Track {
  readonly path: 'translation' | 'rotation' | 'scale' | 'weights';
  /** Index among the joints' nodes; -1 for weights. */
  readonly node: number;
  /** Where its numbers are in a row, and how many. */
  readonly at: number;
  readonly width: number;
  /** How far points move by an error of 1 in it, about: radians, units of length, factors. */
  readonly reach: number;
}

/** Numbers in a row: those of the nodes, then the morph weights. */
export function rowWidth(nodeCount: number, weightCount: number): number {
  return NODE_WIDTH * nodeCount + weightCount;
}

/** How a character is seen in a moment of its takes. */
export interface Moment {
  /** World matrices of the nodes, 16 numbers each. */
  readonly worlds: Float64Array;
  /** The nodes' numbers and the morph weights. */
  readonly row: Float64Array;
}

type Reach = { -readonly [P in 'translation' | 'rotation' | 'scale']: number };

/**
 * All tracks of a character.
 * @param moments in which it reaches as far as it does, about
 */
export function tracksOf(
  nodes: readonly JointNode[],
  moments: readonly Moment[],
  watch: Watch,
  morphCount: number,
): readonly Track[] {
  const reaches = reachesOf(nodes, moments, watch);
  const tracks = nodes.flatMap((node, n): Track[] => {
    const at = NODE_WIDTH * n;
    return [
      { path: 'translation', node: n, at, width: 3, reach: reaches[n].translation },
      { path: 'rotation', node: n, at: at + ROTATION, width: 4, reach: reaches[n].rotation },
      ...(node.hasScale
        ? [{ path: 'scale', node: n, at: at + SCALE, width: 3, reach: reaches[n].scale } as const]
        : []),
    ];
  });
  if (!morphCount) return tracks;
  const at = NODE_WIDTH * nodes.length;
  return [...tracks, { path: 'weights', node: -1, at, width: morphCount, reach: morphReach(moments, watch) }];
}

/**
 * How far the farthest point is moved by each node's translation, rotation and scale: its distance in the space of the
 * node, times the weight of the joints below, times what the nodes above make of a length.
 */
function reachesOf(nodes: readonly JointNode[], moments: readonly Moment[], watch: Watch): readonly Reach[] {
  const { start, nodeOf, local, axisLength } = watch;
  const reaches = nodes.map((): Reach => ({ translation: 0, rotation: axisLength, scale: 0 }));
  const turned = new Float64Array(nodes.length);
  const scaled = new Float64Array(nodes.length);
  const above = new Float64Array(nodes.length);
  const at = new Float64Array(3);
  for (const { worlds, row } of moments) {
    nodes.forEach(({ parent }, n) => {
      above[n] = parent < 0 ? 1 : scaleOf(worlds, 16 * parent);
      reaches[n].translation = Math.max(reaches[n].translation, above[n]);
    });
    for (let p = 0; p + 1 < start.length; p++) {
      turned.fill(0);
      scaled.fill(0);
      for (let i = start[p]; i < start[p + 1]; i++) {
        pointOfPair(watch, i, row, 0, at);
        for (let n = nodeOf[i]; n >= 0; n = nodes[n].parent) {
          const o = NODE_WIDTH * n;
          const factor = local[4 * i + 3] * above[n];
          scaled[n] += factor * Math.hypot(at[0], at[1], at[2]);
          for (let k = 0; k < 3; k++) at[k] *= row[o + SCALE + k];
          turned[n] += factor * Math.hypot(at[0], at[1], at[2]);
          reaches[n].scale = Math.max(reaches[n].scale, scaled[n]);
          reaches[n].rotation = Math.max(reaches[n].rotation, turned[n]);
          turn(row, o + ROTATION, at);
          for (let k = 0; k < 3; k++) at[k] += row[o + k];
        }
      }
    }
  }
  return reaches;
}

/** Turns x y z by the unit quaternion at `o`. */
function turn(q: Float64Array, o: number, v: Float64Array): void {
  const [x, y, z, w] = [q[o], q[o + 1], q[o + 2], q[o + 3]];
  const tx = 2 * (y * v[2] - z * v[1]);
  const ty = 2 * (z * v[0] - x * v[2]);
  const tz = 2 * (x * v[1] - y * v[0]);
  v[0] += w * tx + y * tz - z * ty;
  v[1] += w * ty + z * tx - x * tz;
  v[2] += w * tz + x * ty - y * tx;
}

/** How far the farthest point is moved by any weight of 1. */
function morphReach(moments: readonly Moment[], { start, nodeOf, local, morphStart, by }: Watch): number {
  let reach = 0;
  for (const { worlds } of moments) {
    for (let p = 0; p + 1 < start.length; p++) {
      let sum = 0;
      for (let i = start[p]; i < start[p + 1]; i++) {
        let most = 0;
        for (let k = 3 * morphStart[i]; k < 3 * morphStart[i + 1]; k += 3) {
          most = Math.max(most, Math.hypot(by[k], by[k + 1], by[k + 2]));
        }
        sum += local[4 * i + 3] * most * scaleOf(worlds, 16 * nodeOf[i]);
      }
      reach = Math.max(reach, sum);
    }
  }
  return reach;
}

/** The largest factor by which a matrix lengthens an axis. */
function scaleOf(m: Float64Array, o: number): number {
  return Math.max(...[0, 4, 8].map((c) => Math.hypot(m[o + c], m[o + c + 1], m[o + c + 2])));
}
