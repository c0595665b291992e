/** What of a character moves in a take, and how far an error of it is seen. */
import { type JointNode, NODE_WIDTH, ROTATION, SCALE } from './joint-nodes.ts';
import type { Watch } from './watch.ts';

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

/**
 * All tracks of a character.
 * @param worlds of the nodes in some pose, 16 numbers each
 * @param morphReach the largest displacement by a morph of weight 1; the number of morphs
 */
export function tracksOf(
  nodes: readonly JointNode[],
  worlds: Float64Array,
  watch: Watch,
  morphs: { readonly count: number; readonly reach: number },
): readonly Track[] {
  const reaches = reachesOf(nodes, worlds, watch);
  const tracks = nodes.flatMap((node, n): Track[] => {
    const at = NODE_WIDTH * n;
    const above = node.parent < 0 ? 1 : scaleOf(worlds, 16 * node.parent);
    return [
      { path: 'translation', node: n, at, width: 3, reach: above },
      { path: 'rotation', node: n, at: at + ROTATION, width: 4, reach: reaches[n] },
      ...(node.hasScale ? [{ path: 'scale', node: n, at: at + SCALE, width: 3, reach: reaches[n] } as const] : []),
    ];
  });
  if (!morphs.count) return tracks;
  const at = NODE_WIDTH * nodes.length;
  return [...tracks, { path: 'weights', node: -1, at, width: morphs.count, reach: morphs.reach }];
}

/** How far the farthest point is moved by each node: its distance times the weight of the joints below the node. */
function reachesOf(nodes: readonly JointNode[], worlds: Float64Array, { start, nodeOf, local }: Watch): Float64Array {
  const reaches = new Float64Array(nodes.length);
  const lever = new Float64Array(nodes.length);
  for (let p = 0; p + 1 < start.length; p++) {
    lever.fill(0);
    for (let i = start[p]; i < start[p + 1]; i++) {
      const m = 16 * nodeOf[i];
      const [lx, ly, lz, weight] = local.subarray(4 * i, 4 * i + 4);
      const on = (r: number) =>
        worlds[m + r] * lx + worlds[m + 4 + r] * ly + worlds[m + 8 + r] * lz + worlds[m + 12 + r];
      const [x, y, z] = [on(0), on(1), on(2)];
      for (let n = nodeOf[i]; n >= 0; n = nodes[n].parent) {
        const o = 16 * n + 12;
        lever[n] += weight * Math.hypot(x - worlds[o], y - worlds[o + 1], z - worlds[o + 2]);
        reaches[n] = Math.max(reaches[n], lever[n]);
      }
    }
  }
  return reaches;
}

/** The largest factor by which a matrix lengthens an axis. */
function scaleOf(m: Float64Array, o: number): number {
  return Math.max(...[0, 4, 8].map((c) => Math.hypot(m[o + c], m[o + c + 1], m[o + c + 2])));
}
