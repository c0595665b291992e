/**
 * How the nodes of an FBX scene become nodes with a translation, Euler angles and a scale:
 *
 *     local = T(place) · R(rotation) · S(scale)                                           of most
 *     local = T(place) · S(1 / stretch of the parent)   then   R(rotation) · S(stretch)   where a parent's uneven
 *                                                                                         scale is not inherited
 *
 * The second form is two nodes, of which the upper one is called `NAME_unscale`.
 */

import type { Vec3 } from '../../math/vec3.ts';
import { innerAxis, outerAxis } from '../rotations.ts';
import { drivenKey, type FbxTake } from './animation.ts';
import { NodeMotion, stretchSource } from './motion.ts';
import type { FbxNode } from './nodes.ts';

export interface FbxJoint {
  readonly node: FbxNode;
  /** Index into the scene's nodes. */
  readonly at: number;
  /** That of the node above it that undoes its parent's stretch; -1 for none. */
  readonly unscale: number;
  /** Added to its angles, where its constant rotations are about the axes turned last and first; undefined else. */
  readonly turns: Vec3 | undefined;
  /** Nodes whose stretch its scale is multiplied by and divided by; -1 for none. */
  readonly source: number;
  readonly divisor: number;
}

/** @param first the index of the first scene node to be used */
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
      turns: turnsOf(node),
      source: stretchSource(nodes, i),
      divisor: isNormal ? -1 : node.parent,
    };
  });
}

/** A quaternion's angle about an axis; undefined if it turns about another. */
function angleAbout(q: Float64Array, axis: number): number | undefined {
  const isAbout = [0, 1, 2].every((k) => k === axis || Math.abs(q[k]) < 1e-9);
  if (!isAbout) return undefined;
  const angle = 2 * Math.atan2(q[axis], q[3]);
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}

function turnsOf({ order, pivots }: FbxNode): Vec3 | undefined {
  const before = angleAbout(pivots.before, outerAxis(order));
  const after = angleAbout(pivots.after, innerAxis(order));
  if (before === undefined || after === undefined) return undefined;
  const turns: [number, number, number] = [0, 0, 0];
  turns[outerAxis(order)] += before;
  turns[innerAxis(order)] += after;
  return turns;
}

/** Whether each node is ever stretched by different factors along its axes, as far as its keys say. */
function unevenStretches(nodes: readonly FbxNode[], takes: readonly FbxTake[]): boolean[] {
  const uneven = nodes.map(() => false);
  for (const take of [undefined, ...takes]) {
    const stretch = new Stretches(nodes, take);
    const times = nodes.map(({ object }) => scaleTimes(take, object.id));
    for (const [i] of nodes.entries()) {
      // All times at which one of those it inherits from has a key, and some between.
      const own = new Set<number>([0]);
      for (let a = i; a >= 0; a = nodes[a].inherits === 'normal' ? -1 : nodes[a].parent) {
        for (const time of times[a]) own.add(time);
      }
      for (const time of own) {
        const [x, y, z] = stretch.of(i, time);
        const size = Math.max(Math.abs(x), Math.abs(y), Math.abs(z));
        if (Math.abs(x - y) + Math.abs(x - z) > 1e-5 * size || x === 0) uneven[i] = true;
      }
    }
  }
  return uneven;
}

function scaleTimes(take: FbxTake | undefined, id: string): number[] {
  const times: number[] = [];
  for (const { driven } of take?.layers ?? []) {
    for (const curve of driven.get(drivenKey(id, 'Lcl Scaling'))?.curves ?? []) {
      for (const [i, time] of curve?.times.entries() ?? []) {
        times.push(time);
        if (curve && i > 0)
          times.push((curve.times[i - 1] + time) / 2, curve.times[i - 1] + 0.2 * (time - curve.times[i - 1]));
      }
    }
  }
  return times;
}

const ONE: Vec3 = [1, 1, 1];

/** How much nodes are stretched along their axes at a time of a take, by what they inherit and by their own scale. */
export class Stretches {
  private readonly motions: readonly NodeMotion[];

  constructor(
    private readonly nodes: readonly FbxNode[],
    take: FbxTake | undefined,
  ) {
    this.motions = nodes.map((node) => new NodeMotion(node, take));
  }

  of(i: number, time: number): Vec3 {
    if (i < 0) return ONE;
    const motion = this.motions[i];
    motion.at(time);
    const [x, y, z] = motion.scale;
    const source = stretchSource(this.nodes, i);
    if (source < 0) return [x, y, z];
    const [a, b, c] = this.of(source, time);
    return [x * a, y * b, z * c];
  }
}
