/**
 * Which joint of which character an instance of the skeleton drawing is. A skeleton's nodes are its joints followed by
 * its End Sites and the bone tips without a joint (`model/bone-ends.ts`), both called End Sites here; every kind of
 * shape has an instance for each node:
 *
 *     character 0: placement 0: node 0 1 2 … placement 1: node 0 1 2 …   character 1: …
 *
 * Picking or hovering an End Site means the joint that it ends.
 */
import { endsAt, hasStretches } from '../../evaluate/end-sites.ts';
import { type JointSizes, jointSizes } from '../../evaluate/shapes/joint-shapes.ts';
import { perObject } from '../../model/per-object.ts';
import { boneEnds } from '../../model/skeleton/bone-ends.ts';
import { arePoints } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Tint } from '../theme.ts';

/** A character's joints to be drawn. The arrays are kept by reference and read when drawing. */
export interface PosedSkeleton {
  readonly characterId: string;
  /** The character's name. */
  readonly name?: string;
  readonly skeleton: Skeleton;
  /** 16 numbers per joint, in the character's space. */
  readonly world: Float64Array;
  /** All DOFs of the character, as posed. */
  readonly dofs: Float64Array;
  /** 16 numbers per placement. */
  readonly placements: Float64Array;
  readonly hasSkin: boolean;
  /** Absent without a skin. */
  readonly skinShape?: SkinShape;
  /** Overrides the joints' own colours. */
  readonly tint?: Tint;
  /** Whether bones are drawn, in place of boxes, whatever the display has. */
  readonly withBones?: boolean;
}

/** Where a skin is, roughly, in the current pose. */
export interface SkinShape {
  /** See `evaluate/shapes/skin-parts.ts`; undefined while it isn't shown. */
  readonly skinParts: Float64Array | undefined;
  /** W·B⁻¹, 16 numbers per joint; undefined if nothing moves it. */
  readonly skinMatrices: Float64Array | undefined;
}

/** A skeleton with its range of instances. */
export interface DrawnSkeleton extends PosedSkeleton {
  readonly sizes: JointSizes;
  readonly nodes: Nodes;
  readonly firstInstance: number;
  readonly placementCount: number;
  /** Of points: 1 for each that is missing in the frame that is drawn. */
  readonly missing?: Uint8Array;
}

/** Whether joint indices mean the same joints in both. If not, state kept by index (such as hovering) is invalid. */
export function haveSameJoints(a: Skeleton | undefined, b: Skeleton | undefined): boolean {
  if (a === b) return true;
  if (!a || !b || a.joints.length !== b.joints.length) return false;
  return a.joints.every(({ name, parent }, j) => name === b.joints[j].name && parent === b.joints[j].parent);
}

/** One joint at one placement. */
export interface JointRef {
  readonly characterId: string;
  readonly placement: number;
  readonly joint: number;
}

/** Joints first, then End Sites. */
export interface Nodes {
  readonly count: number;
  readonly jointCount: number;
  /** For each node, the one where its bone starts; -1 for a root. */
  readonly parents: Int32Array;
  /** The joint that each End Site ends. */
  readonly owners: Int32Array;
  /** x y z of each End Site, in its joint's space. */
  readonly ends: Float64Array;
  /** The same with ends as posed (`posedNodes`); absent if no DOF moves any. */
  readonly posed?: Nodes;
}

/** The nodes with End Sites where the DOFs have them, until the next call for this skeleton. */
export function posedNodes(nodes: Nodes, skeleton: Skeleton, dofs: Float64Array): Nodes {
  const { owners, ends, posed } = nodes;
  if (!posed) return nodes;
  endsAt(skeleton, owners, ends, dofs, 0, posed.ends);
  return posed;
}

function nodesOf(skeleton: Skeleton): Nodes {
  const jointCount = skeleton.joints.length;
  const ends = boneEnds(skeleton);
  const nodes: Nodes = {
    count: jointCount + ends.length,
    jointCount,
    parents: Int32Array.from([...skeleton.joints.map((j) => j.parent), ...ends.map((e) => e.joint)]),
    owners: Int32Array.from(ends, ({ joint }) => joint),
    ends: Float64Array.from(ends.flatMap(({ at }) => at)),
  };
  return hasStretches(skeleton) ? { ...nodes, posed: { ...nodes, ends: nodes.ends.slice() } } : nodes;
}

/** `jointSizes`, cached per skeleton. */
export const sizesFor = perObject((skeleton: Skeleton) => jointSizes(skeleton));
export const nodesFor = perObject(nodesOf);

/** Assigns each skeleton its instances, consecutively. */
export function assignInstances(skeletons: readonly PosedSkeleton[]): DrawnSkeleton[] {
  let next = 0;
  return skeletons.map((posed) => {
    const [sizes, nodes] = [sizesFor(posed.skeleton), nodesFor(posed.skeleton)];
    const placementCount = posed.placements.length / 16;
    const firstInstance = next;
    next += placementCount * nodes.count;
    const missing = arePoints(posed.skeleton) && { missing: new Uint8Array(nodes.jointCount) };
    return { ...posed, sizes, nodes, firstInstance, placementCount, ...missing };
  });
}

export function instancesOf(drawn: readonly DrawnSkeleton[]): number {
  const last = drawn.at(-1);
  return last ? last.firstInstance + last.placementCount * last.nodes.count : 0;
}

/** The instance of a joint; -1 if there is none. */
export function instanceOf(
  drawn: readonly DrawnSkeleton[],
  characterId: string | undefined,
  placement: number,
  joint: number | undefined,
): number {
  const found = drawn.find((d) => d.characterId === characterId);
  if (!found || joint === undefined || joint >= found.nodes.jointCount || placement >= found.placementCount) return -1;
  return found.firstInstance + placement * found.nodes.count + joint;
}

/** An instance's skeleton, placement and node. */
function nodeAt(drawn: readonly DrawnSkeleton[], instance: number) {
  for (const of of drawn) {
    const i = instance - of.firstInstance;
    const { count } = of.nodes;
    if (i >= 0 && i < of.placementCount * count) return { of, placement: Math.floor(i / count), node: i % count };
  }
  return undefined;
}

/** The joint of an instance; for an End Site, the one that it ends. */
export function jointAt(drawn: readonly DrawnSkeleton[], instance: number): JointRef | undefined {
  const found = nodeAt(drawn, instance);
  if (!found) return undefined;
  const { of, placement, node } = found;
  const { jointCount, owners } = of.nodes;
  const joint = node < jointCount ? node : owners[node - jointCount];
  return { characterId: of.characterId, placement, joint };
}

/** The joint where the bone of an instance starts. */
export function boneOwner(drawn: readonly DrawnSkeleton[], instance: number): JointRef | undefined {
  const found = nodeAt(drawn, instance);
  if (!found) return undefined;
  return { characterId: found.of.characterId, placement: found.placement, joint: ownerOf(found.of, found.node) };
}

/** The joint where the bone to a node starts; a root itself. */
export function ownerOf({ nodes, skeleton }: DrawnSkeleton, node: number): number {
  if (node >= nodes.jointCount) return nodes.owners[node - nodes.jointCount];
  return Math.max(0, skeleton.joints[node].parent);
}
