/**
 * A compared skeleton over the scene, at every placement of its character: our joints by how they compare, and the
 * other program's as a ghost. Beside ours, the ghost has only what differs, so that what agrees stays readable.
 */
import { Group } from 'three';
import { setIdentity } from '../../math/mat4.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { type Nodes, nodesFor, sizesFor } from '../skeleton/drawn-skeletons.ts';
import { NODE_STRIDE } from '../skeleton/node-buffer.ts';
import { fillNodes, placementScale, placePositions } from '../skeleton/node-matrices.ts';
import type { StageTheme } from '../theme.ts';
import { AGREES, INHERITED, LIT, NO_LOOK, NodeLooks, OWN, THEIRS } from './node-looks.ts';

/** Over bones behind a skin, under the markers of selected joints. */
const OURS_ORDER = 16;
const THEIRS_ORDER = 18;
const GHOST_OPACITY = 0.66;
/** How thick nodes are drawn, by their looks: wrong ones are thicker than others. */
const THICKNESS: Readonly<Record<number, number>> = { [AGREES]: 1.1, [OWN]: 1.7, [INHERITED]: 1.35 };

/** How a joint compares: it agrees, is wrong by itself or only because a parent is, or which of both isn't known. */
export type JointVerdict = 'agrees' | 'own' | 'inherited' | 'differs';
const LOOKS: Readonly<Record<JointVerdict, number>> = { agrees: AGREES, own: OWN, inherited: INHERITED, differs: OWN };

/** One joint at one placement. */
export interface JointAt {
  readonly joint: number;
  readonly placement: number;
}

/** What is drawn of a comparison. */
export type ComparedSide = 'ours' | 'theirs' | 'both';

export interface ComparedJoints {
  readonly skeleton: Skeleton;
  /** One per joint. */
  readonly verdicts: readonly JointVerdict[];
  /** 16 numbers per joint, column-major, in the character's own space. */
  readonly ours: Float64Array;
  /** The same, or x y z per joint. */
  readonly theirs: Float64Array;
  /** Places nearer to each other agree. */
  readonly tolerance: number;
}

export class ComparedSkeleton {
  readonly object = new Group();
  private readonly ours = new NodeLooks(OURS_ORDER, 1);
  private readonly ghost = new NodeLooks(THEIRS_ORDER, GHOST_OPACITY);
  private skeleton: Skeleton | undefined;
  private placementCount = 0;
  /** 16 numbers per joint; of positions only the translations mean something. */
  private theirWorld: Float64Array = new Float64Array(0);
  /** Looks of all balls and bones of ours. */
  private ballLooks = new Uint8Array(0);
  private boneLooks = new Uint8Array(0);
  private positions = new Float64Array(0);
  private hovered: JointAt | undefined;

  constructor() {
    this.object.add(this.ours.object, this.ghost.object);
    this.object.visible = false;
  }

  setTheme(theme: StageTheme): void {
    for (const part of [this.ours, this.ghost]) part.setTheme(theme);
  }

  /** @param compared undefined: nothing is drawn */
  show(compared: ComparedJoints | undefined, side: ComparedSide, placementCount: number): void {
    this.object.visible = compared !== undefined;
    this.ours.object.visible = side !== 'theirs';
    this.ghost.object.visible = side !== 'ours';
    this.skeleton = compared?.skeleton;
    if (!compared) return;
    const { skeleton, verdicts, theirs, ours, tolerance } = compared;
    const nodes = nodesFor(skeleton);
    this.placementCount = placementCount;
    if (this.positions.length < 3 * nodes.count * placementCount) {
      this.positions = new Float64Array(3 * nodes.count * placementCount);
    }
    const lookOf = (joint: number) => LOOKS[verdicts[joint]];
    this.ballLooks = perNode(nodes, placementCount, (n) => lookOf(jointOf(nodes, n)));
    this.boneLooks = perNode(nodes, placementCount, (n) => (nodes.parents[n] < 0 ? NO_LOOK : lookOf(nodes.parents[n])));
    this.paint(nodes);

    const hasEnds = theirs.length === 16 * nodes.jointCount;
    this.theirWorld = hasEnds ? theirs : worldOf(theirs);
    const isElsewhere = differing(nodes, ours, this.theirWorld, tolerance);
    const isSeen = (n: number) => side === 'theirs' || isElsewhere[n] === 1;
    const isThere = (n: number) => (n < nodes.jointCount || hasEnds) && isFinite16(this.theirWorld, jointOf(nodes, n));
    this.ghost.setLooks(
      perNode(nodes, placementCount, (n) => (isSeen(n) && isThere(n) ? THEIRS : NO_LOOK)),
      perNode(nodes, placementCount, (n) => {
        const parent = nodes.parents[n];
        if (parent < 0 || !isThere(n) || !isThere(parent)) return NO_LOOK;
        return isSeen(n) || isSeen(parent) ? THEIRS : NO_LOOK;
      }),
    );
  }

  /** Lights up a joint of ours, with the bones that start there. */
  hover(joint: JointAt | undefined): void {
    this.hovered = joint;
    if (this.skeleton) this.paint(nodesFor(this.skeleton));
  }

  /**
   * Call before each frame; allocates nothing.
   *
   * @param world ours now, 16 numbers per joint, in the character's own space
   * @param placements 16 numbers per placement
   */
  fill(world: Float64Array, placements: Float64Array): void {
    const { skeleton, placementCount, ours, ghost, ballLooks, boneLooks } = this;
    if (!skeleton || placements.length < 16 * placementCount || world.length < 16 * skeleton.joints.length) return;
    if (ghost.object.visible) this.fillNodes(ghost, skeleton, this.theirWorld, placements);
    if (!ours.object.visible) return;
    this.fillNodes(ours, skeleton, world, placements);
    const { values } = ours.nodes;
    for (let n = 0; n < ballLooks.length; n++) {
      values[NODE_STRIDE * n + 3] *= THICKNESS[ballLooks[n]];
      if (boneLooks[n] !== NO_LOOK) values[NODE_STRIDE * n + 7] *= THICKNESS[boneLooks[n]];
    }
  }

  dispose(): void {
    this.ours.dispose();
    this.ghost.dispose();
  }

  private paint(nodes: Nodes): void {
    const { hovered, ballLooks, boneLooks } = this;
    const isLit = (i: number, joint: number) =>
      joint === hovered?.joint && Math.floor(i / nodes.count) === hovered.placement;
    const lit = (looks: Uint8Array, jointOfNode: (node: number) => number) =>
      looks.map((look, i) => (look !== NO_LOOK && isLit(i, jointOfNode(i % nodes.count)) ? look + LIT : look));
    this.ours.setLooks(
      // The ball of an End Site is coloured like its bone.
      lit(ballLooks, (n) => jointOf(nodes, n)),
      lit(boneLooks, (n) => nodes.parents[n]),
    );
  }

  private fillNodes(part: NodeLooks, skeleton: Skeleton, world: Float64Array, placements: Float64Array): void {
    const nodes = nodesFor(skeleton);
    const sizes = sizesFor(skeleton);
    const { positions } = this;
    for (let p = 0; p < this.placementCount; p++) {
      const first = p * nodes.count;
      placePositions(nodes, placements, 16 * p, world, positions, first);
      fillNodes(nodes, sizes, placementScale(placements, 16 * p), positions, part.nodes.values, first);
    }
    part.nodes.filled();
  }
}

/** A look for each node at each placement. */
function perNode({ count }: Nodes, placementCount: number, lookOf: (node: number) => number): Uint8Array<ArrayBuffer> {
  const looks = new Uint8Array(count * placementCount);
  for (let n = 0; n < count; n++) looks[n] = lookOf(n);
  for (let p = 1; p < placementCount; p++) looks.copyWithin(p * count, 0, count);
  return looks;
}

/** The joint that a node is, or ends. */
function jointOf({ jointCount, owners }: Nodes, node: number): number {
  return node < jointCount ? node : owners[node - jointCount];
}

const ORIGIN = Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);

/** Per node, 1 if it isn't at the same place in both. */
function differing(nodes: Nodes, ours: Float64Array, theirs: Float64Array, tolerance: number): Uint8Array {
  const [a, b] = [ours, theirs].map((world) => {
    const positions = new Float64Array(3 * nodes.count);
    placePositions(nodes, ORIGIN, 0, world, positions, 0);
    return positions;
  });
  // Not `>`: NaN differs too.
  const isNear = (i: number) => Math.abs(a[i] - b[i]) <= tolerance;
  return Uint8Array.from({ length: nodes.count }, (_, n) =>
    isNear(3 * n) && isNear(3 * n + 1) && isNear(3 * n + 2) ? 0 : 1,
  );
}

/** Matrices that only translate. */
function worldOf(positions: Float64Array): Float64Array<ArrayBuffer> {
  const world = new Float64Array((16 * positions.length) / 3);
  for (let j = 0; 3 * j < positions.length; j++) {
    setIdentity(world, 16 * j);
    for (let k = 0; k < 3; k++) world[16 * j + 12 + k] = positions[3 * j + k];
  }
  return world;
}

function isFinite16(world: Float64Array, joint: number): boolean {
  for (let i = 16 * joint; i < 16 * joint + 16; i++) if (!Number.isFinite(world[i])) return false;
  return true;
}
