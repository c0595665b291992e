/**
 * The nodes that show a skeleton's joints in FBX, and how each of their numbers follows from DOFs:
 *
 *     local matrix of a node = T · P · R(angles in an order) · Q⁻¹ · S
 *
 * with constant rotations P (PreRotation) and Q (PostRotation). A joint whose matrix is a product of screws is one node
 * where all translations come before the rotations, and these are about axes at right angles: P turns x, y and z to
 * them. Any other joint is a chain of nodes, each the parent of the next, whose product is its matrix; children of the
 * joint hang below the last one. Numbers are sums of DOFs, so that curves are kept; those that are not are fitted.
 */
import type { CompiledSkeleton } from '../../evaluate/kinematics.ts';
import type { MotionPart, Screw } from '../../evaluate/motions/motion.ts';
import { jointMotion } from '../../evaluate/motions.ts';
import { quaternionOfRotation } from '../../math/quaternion.ts';
import { acrossOf, cross, negated, type Vec3 } from '../../math/vec3.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import { EULER_ORDERS, type EulerOrder, type Joint, type Skeleton } from '../../model/skeleton/skeleton.ts';
import { stretchOf } from '../../model/skeleton/stretch.ts';
import type { JointNodes } from '../shared/joint-nodes.ts';

/** A number that follows DOFs: constant + Σ gain · DOF. */
export interface Sum {
  readonly constant: number;
  readonly terms: readonly Term[];
}

/** A DOF of the character, and what it is multiplied by. */
export interface Term {
  readonly dof: number;
  readonly gain: number;
}

/** The sums of x, y and z. */
export type Sums = readonly [Sum, Sum, Sum];

/** A node of a joint's chain. */
export interface NodeRule {
  readonly joint: number;
  /** Index of the parent among the nodes, smaller than its own; -1 for the root's first. */
  readonly parent: number;
  /** Position in the joint's chain, from 0. */
  readonly place: number;
  readonly translation: Sums;
  /** Of its angles. */
  readonly order: EulerOrder;
  /** Quaternions x y z w; absent: none. */
  readonly before?: Float64Array;
  readonly after?: Float64Array;
  /** Radians about x, y and z; `fitted`: those of the rotation of the glTF node `fit`. */
  readonly rotation: Sums | 'fitted';
  /** `fitted`: that of the glTF node `fit`. */
  readonly scale: Sums | 'fitted';
  /** The glTF node (`joint-nodes.ts`) that has what is fitted; -1 if nothing is. */
  readonly fit: number;
}

/** The nodes of all joints. */
export interface NodeRules {
  readonly nodes: readonly NodeRule[];
  /** The last node of each joint. */
  readonly lastOf: Int32Array;
}

type Parts = Omit<NodeRule, 'joint' | 'parent' | 'place'>;

const ZERO: Sum = { constant: 0, terms: [] };
const ONE: Sum = { constant: 1, terms: [] };
/** No translation, or no rotation. */
const NONE: Sums = [ZERO, ZERO, ZERO];
const UNSCALED: Sums = [ONE, ONE, ONE];
const PLAIN: Parts = { translation: NONE, order: 'xyz', rotation: NONE, scale: UNSCALED, fit: -1 };

/**
 * The nodes of a skeleton, in depth-first order of its joints.
 * @param fits the same joints as glTF has them
 */
export function nodeRules(skeleton: Skeleton, compiled: CompiledSkeleton, fits: JointNodes): NodeRules {
  const nodes: NodeRule[] = [];
  const lastOf = new Int32Array(compiled.jointCount);
  const fitsOf = skeleton.joints.map((): number[] => []);
  fits.nodes.forEach(({ joint }, n) => {
    fitsOf[joint].push(n);
  });
  skeleton.joints.forEach((joint, j) => {
    let parent = joint.parent < 0 ? -1 : lastOf[joint.parent];
    const chain = chainOf(joint, compiled.firstDof[j], fits, fitsOf[j]);
    chain[0] = { ...chain[0], translation: plus(startOf(skeleton, compiled, j), chain[0].translation) };
    chain.forEach((parts, place) => {
      nodes.push({ ...parts, joint: j, parent, place });
      parent = nodes.length - 1;
    });
    lastOf[j] = parent;
  });
  return { nodes, lastOf };
}

/** Where a joint is before it moves: its offset, the root's translation, and the tip of a bone that a DOF lengthens. */
function startOf({ joints }: Skeleton, compiled: CompiledSkeleton, j: number): Sums {
  const { parent } = joints[j];
  const stretch = parent < 0 ? undefined : stretchOf(joints[parent]);
  return sums((k) => ({
    constant: compiled.offsets[3 * j + k],
    terms: [
      ...(parent < 0 && compiled.hasRootTranslation ? [{ dof: k, gain: 1 }] : []),
      ...(stretch ? terms(compiled.firstDof[parent] + stretch.dof, stretch.along[k]) : []),
    ],
  }));
}

function chainOf({ motion }: Joint, first: number, fits: JointNodes, own: readonly number[]): Parts[] {
  const { screws, turned, parts } = jointMotion(motion);
  const all = screws ?? turned?.screws;
  const names = dofsOf(motion).map(({ name }) => name);
  if (all) {
    const chain = runsOf(all).map((run) => screwNode(run, first, names));
    return turned ? withTurn(chain, turned.by) : chain;
  }
  if (!parts) return [{ ...PLAIN, rotation: 'fitted', fit: own[0] }];
  return own.map((fit) => partsNode(fits.nodes[fit].parts ?? [], fit, first));
}

/** Screws that one node can do: slides, then at most three turns about axes at right angles. */
function runsOf(screws: readonly Screw[]): readonly (readonly Screw[])[] {
  const runs: Screw[][] = [[]];
  for (const screw of screws) {
    const run = runs[runs.length - 1];
    const turns = run.filter(({ turn }) => turn === 1);
    // What slides does so before the turns.
    const fits = turns.length === 0 || (screw.slide === 0 && turns.every(({ axis }) => isAcross(axis, screw.axis)));
    if (fits) run.push(screw);
    else runs.push([screw]);
  }
  return runs;
}

function isAcross(a: Vec3, b: Vec3): boolean {
  return Math.abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) < 1e-9;
}

function screwNode(run: readonly Screw[], first: number, names: readonly string[]): Parts {
  const translation = run.reduce(
    (sum, { axis, slide, dof }) =>
      plus(
        sum,
        sums((k) => ({ constant: 0, terms: terms(first + dof, slide * axis[k]) })),
      ),
    NONE,
  );
  const turns = run.filter(({ turn }) => turn === 1);
  if (turns.length === 0) return { ...PLAIN, translation };
  const { matrix, about } = frameOf(turns, names);
  const rotation = sums((k) => ({
    constant: 0,
    terms: turns.flatMap(({ dof }, i) => (about[i].axis === k ? terms(first + dof, about[i].sign) : [])),
  }));
  const order = orderOf(about.map(({ axis }) => axis));
  if (matrix.every((value, i) => value === (i % 4 === 0 ? 1 : 0))) return { ...PLAIN, translation, order, rotation };
  const turn = new Float64Array(4);
  quaternionOfRotation(matrix, 0, turn);
  return { ...PLAIN, translation, order, rotation, before: turn, after: turn };
}

/** Which of x, y, z an axis is in the frame of a node, and whether it points along it or against. */
interface About {
  readonly axis: number;
  readonly sign: 1 | -1;
}

/** A frame in which all axes of turns are x, y or z: 9 numbers, column-major. */
function frameOf(turns: readonly Screw[], names: readonly string[]): { matrix: Float64Array; about: readonly About[] } {
  const main = turns.map(({ axis }) => mainAxis(axis));
  if (main.every((one) => one !== undefined))
    return { matrix: Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1), about: main };
  const stated = turns.map(({ dof }) => 'xyz'.indexOf(names[dof].at(-1) ?? ''));
  const isStated = stated.every((k, i) => k >= 0 && stated.indexOf(k) === i);
  const axes = isStated ? stated : turns.map((_, i) => i);
  const columns: (Vec3 | undefined)[] = [undefined, undefined, undefined];
  axes.forEach((k, i) => {
    columns[k] = turns[i].axis;
  });
  if (turns.length === 1) columns[(axes[0] + 1) % 3] = acrossOf(turns[0].axis);
  const missing = columns.indexOf(undefined);
  const column = (k: number) => columns[k % 3] ?? ([0, 0, 0] as const);
  if (missing >= 0) columns[missing] = cross(column(missing + 1), column(missing + 2));
  // Mirrored axes are a frame with one of them reversed.
  const [x, y, z] = [column(0), column(1), column(2)];
  const up = cross(x, y);
  const isMirrored = up[0] * z[0] + up[1] * z[1] + up[2] * z[2] < 0;
  const last = axes[axes.length - 1];
  if (isMirrored) columns[last] = negated(column(last));
  return {
    matrix: Float64Array.from([0, 1, 2].flatMap((k) => [...column(k)])),
    about: axes.map((axis) => ({ axis, sign: isMirrored && axis === last ? -1 : 1 })),
  };
}

function mainAxis(axis: Vec3): About | undefined {
  const k = axis.findIndex((value) => Math.abs(value) === 1);
  if (k < 0 || axis.some((value, i) => i !== k && value !== 0)) return undefined;
  return { axis: k, sign: axis[k] < 0 ? -1 : 1 };
}

/** The order of turns that are multiplied from left to right, with the axes that nothing turns about; `xyz` if it fits. */
function orderOf(axes: readonly number[]): EulerOrder {
  const applied = axes.map((k) => 'xyz'[k]).reverse();
  const fits = (order: EulerOrder) =>
    applied.every((axis, i) => i === 0 || order.indexOf(axis) > order.indexOf(applied[i - 1]));
  return EULER_ORDERS.find(fits) ?? 'xyz';
}

/** A chain with a constant rotation at its end. */
function withTurn(chain: Parts[], by: Float64Array): Parts[] {
  const last = chain[chain.length - 1];
  const turn = new Float64Array(4);
  quaternionOfRotation(by, 0, turn);
  // P · R · Q⁻¹ · C, and Q is P where the axes were turned by C.
  if (last.after && isSame(last.after, turn)) {
    const { after: _, ...rest } = last;
    return [...chain.slice(0, -1), rest];
  }
  const back = Float64Array.of(-turn[0], -turn[1], -turn[2], turn[3]);
  return last.after ? [...chain, { ...PLAIN, before: turn }] : [...chain.slice(0, -1), { ...last, after: back }];
}

function isSame(a: Float64Array, b: Float64Array): boolean {
  return Math.abs(a.reduce((sum, value, k) => sum + value * b[k], 0)) > 1 - 1e-14;
}

/** A node of a motion that stretches: translations, then rotations, then scales. */
function partsNode(parts: readonly MotionPart[], fit: number, first: number): Parts {
  const ofKind = (kind: MotionPart['kind']) => parts.filter((part) => part.kind === kind);
  const along = (kind: MotionPart['kind'], rest: number): Sums | undefined => {
    const own = ofKind(kind);
    if (!own.every(({ by }) => by)) return undefined;
    return sums((k) => {
      const dofs = own.flatMap(({ by }) => (by?.axes.includes(k) ? [{ dof: first + by.dof, gain: 1 }] : []));
      return dofs.length ? { constant: 0, terms: dofs } : { constant: rest, terms: [] };
    });
  };
  const rotation = along('rotation', 0) ?? 'fitted';
  const scale = along('scale', 1) ?? 'fitted';
  return {
    translation: along('translation', 0) ?? NONE,
    order: orderOf(ofKind('rotation').flatMap(({ by }) => by?.axes ?? [])),
    rotation,
    scale,
    fit: rotation === 'fitted' || scale === 'fitted' ? fit : -1,
  };
}

function sums(of: (k: number) => Sum): Sums {
  return [of(0), of(1), of(2)];
}

function plus(a: Sums, b: Sums): Sums {
  return sums((k) => ({ constant: a[k].constant + b[k].constant, terms: [...a[k].terms, ...b[k].terms] }));
}

function terms(dof: number, gain: number): readonly Term[] {
  return gain === 0 ? [] : [{ dof, gain }];
}

/** The value of a sum in a pose of all DOFs. */
export function sumAt({ constant, terms: all }: Sum, dofs: ArrayLike<number>): number {
  let value = constant;
  for (let i = 0; i < all.length; i++) value += all[i].gain * dofs[all[i].dof];
  return value;
}
