/**
 * How the nodes of an FBX scene become nodes with a translation, Euler angles and a scale:
 *
 *     local = T(place) · R(rotation) · S(scale)                                           of most
 *     local = T(place) · S(1 / stretch of the parent)   then   R(rotation) · S(stretch)   where a parent's uneven
 *                                                                                         scale is not inherited
 *
 * The second form is two nodes, of which the upper one is called `NAME_unscale`.
 */

import type { FbxTake } from './animation.ts';
import { type KeptAngles, keptAngles } from './kept-angles.ts';
import { NodeMotion, stretchSource } from './motion.ts';
import type { FbxNode } from './nodes.ts';

/** How one node of the file becomes one or two nodes of the scene. */
export interface FbxJoint {
  readonly node: FbxNode;
  /** Index into the scene's nodes. */
  readonly at: number;
  /** That of the node above it that undoes its parent's stretch; -1 for none. */
  readonly unscale: number;
  /** How its curves are those of the joint; undefined where constant rotations make other angles of them. */
  readonly kept: KeptAngles | undefined;
  /** Nodes whose stretch its scale is multiplied by and divided by; -1 for none. */
  readonly source: number;
  readonly divisor: number;
}

/**
 * Decides how each node of the file becomes nodes of the scene.
 * @param first the index of the first scene node to be used
 */
export function jointsOf(nodes: readonly FbxNode[], takes: readonly FbxTake[], first: number): FbxJoint[] {
  const uneven = unevenStretches(nodes, takes);
  let next = first;
  return nodes.map((node, i) => {
    const isNormal = node.inherits === 'normal';
    const needsTwo = !isNormal && uneven[node.parent];
    const unscale = needsTwo ? next++ : -1;
    return {
      node,
      at: next++,
      unscale,
      kept: keptAngles(node, takes),
      source: stretchSource(nodes, i),
      divisor: isNormal ? -1 : node.parent,
    };
  });
}

/** Times of a take at which stretches are compared, at most. */
const MAX_TIMES = 5000;

/**
 * Whether nodes are ever stretched by different factors along their axes, as far as their keys say: those whose children
 * inherit it in another way than usual, which alone depend on it.
 */
function unevenStretches(nodes: readonly FbxNode[], takes: readonly FbxTake[]): boolean[] {
  const uneven = nodes.map(() => false);
  // Most files have none that depends on it.
  const asked = nodes.flatMap(({ inherits, parent }) => (inherits === 'normal' || parent < 0 ? [] : [parent]));
  if (asked.length === 0) return uneven;
  for (const take of [undefined, ...takes]) {
    const stretches = new Stretches(nodes, take);
    for (const time of scaleTimes(take, nodes)) {
      for (const i of asked) {
        if (uneven[i]) continue;
        const stretch = stretches.of(i, time);
        const x = stretch[0];
        const y = stretch[1];
        const z = stretch[2];
        const size = Math.max(Math.abs(x), Math.abs(y), Math.abs(z));
        if (Math.abs(x - y) + Math.abs(x - z) > 1e-5 * size || x === 0) uneven[i] = true;
      }
      if (asked.every((i) => uneven[i])) return uneven;
    }
  }
  return uneven;
}

/** All times at which a scale has a key, and some between; only one for those that never change. */
function scaleTimes(take: FbxTake | undefined, nodes: readonly FbxNode[]): readonly number[] {
  const times = new Set<number>([0]);
  const { layers = [] } = take ?? {};
  for (const { driven } of layers) {
    for (const { object } of nodes) {
      for (const curve of driven.get(object.id)?.get('Lcl Scaling')?.curves ?? []) {
        // Weights of layers may change what constant curves make.
        if (layers.length === 1 && curve?.isConstant) continue;
        curve?.times.forEach((time, i) => {
          times.add(time);
          if (i === 0) return;
          const before = curve.times[i - 1];
          times.add((before + time) / 2).add(before + 0.2 * (time - before));
        });
      }
    }
  }
  const every = Math.ceil(times.size / MAX_TIMES);
  return [...times].filter((_, i) => i % every === 0);
}

const ONE = Float64Array.of(1, 1, 1);

/** How much nodes are stretched along their axes at a time of a take, by what they inherit and by their own scale. */
export class Stretches {
  private readonly motions: (NodeMotion | undefined)[] = [];
  private readonly stretches: Float64Array[] = [];

  constructor(
    private readonly nodes: readonly FbxNode[],
    private readonly take: FbxTake | undefined,
  ) {}

  /** The factors of node `i` with those that it inherits, at a time in seconds; 1 for −1. Scratch of this node. */
  of(i: number, time: number): Float64Array {
    if (i < 0) return ONE;
    // Of few nodes anything is asked.
    const motion = this.motions[i] ?? new NodeMotion(this.nodes[i], this.take);
    this.motions[i] = motion;
    motion.scaleAt(time);
    const source = stretchSource(this.nodes, i);
    if (source < 0) return motion.scale;
    const inherited = this.of(source, time);
    const stretch = this.stretches[i] ?? new Float64Array(3);
    this.stretches[i] = stretch;
    for (let k = 0; k < 3; k++) stretch[k] = motion.scale[k] * inherited[k];
    return stretch;
  }
}
