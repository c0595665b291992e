/**
 * The way of a joint from its channels to its world matrix, step by step:
 *
 *     values     of its DOFs: from channel or pose → within limits (`dof-steps.ts`)
 *     factors    L = T(t) · T(offset) · F₁ · F₂ …      T(t), the root translation, of the root only; F of the joint's type
 *     world      W = W of the parent · L
 *
 * The factors, multiplied by `productOfFactors`, are L to the last bit, as `worldMatrices` has it: they have so many
 * zeros and ones that no sum is rounded differently.
 */
import { compileSkeleton, localMatrices, worldMatrices } from '../../evaluate/kinematics.ts';
import { direction } from '../../evaluate/motions/axis.ts';
import { factorOf, productOf } from '../../evaluate/motions/product.ts';
import { jointMotion } from '../../evaluate/motions.ts';
import { multiplyAffine, setIdentity } from '../../math/mat4.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { formulaOf } from '../../model/joint-types/texts.ts';
import { rootDofs } from '../../model/skeleton/dofs.ts';
import { axisOf, dofsOf, factorsOf, offsetBesideDofs } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { type DofStep, type PoseSteps, stepsOfDof } from './dof-steps.ts';
import { dofSymbol, type Formula, jointSymbol } from './formula.ts';

/** One of the matrices that a local matrix is a product of. */
export interface Factor {
  /** `Rz(rz)`. */
  readonly symbol: Formula;
  /** The factor's effect on a point, or how it is made. */
  readonly law: string;
  /** Column-major. */
  readonly matrix: Float64Array;
  /** Into the character's DOFs; empty for the offset. */
  readonly dofs: readonly number[];
}

/** The steps by which a joint gets its world matrix; matrices have 16 numbers. */
export interface JointSteps {
  readonly joint: number;
  /** In the order of the joint's DOFs; of a root with root translation those first. */
  readonly values: readonly DofStep[];
  /** From left to right; at least the offset's. */
  readonly factors: readonly Factor[];
  /** How many of the factors are before those of the joint's type. */
  readonly ownFrom: number;
  /** Which factors of the joint's type are multiplied first. */
  readonly groups: 'left' | 'right';
  /** `L₇ = T(offset) · Rz(rz) · …`. */
  readonly localFormula: Formula;
  /** Column-major. */
  readonly local: Float64Array;
  /** -1 for the root. */
  readonly parent: number;
  /** W of the parent; the identity for the root. */
  readonly parentWorld: Float64Array;
  /** `W₇ = W₃ · L₇`. */
  readonly worldFormula: Formula;
  readonly world: Float64Array;
}

/** Undefined if the character has no such joint. */
export function stepsOfJoint(pose: PoseSteps, joint: number): JointSteps | undefined {
  const { character, dofs } = pose;
  const { skeleton } = character;
  const described = skeleton?.joints[joint];
  if (!skeleton || !described) return undefined;
  const compiled = compileSkeleton(skeleton);
  const worlds = new Float64Array(16 * compiled.jointCount);
  const locals = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, worlds);
  localMatrices(compiled, dofs, locals);
  const { parent } = described;
  const before = factorsBefore(skeleton, joint, dofs);
  const own = ownFactors(skeleton, joint, dofs, compiled.firstDof[joint]);
  const factors = [...before, ...own];
  const local = jointSymbol('L', joint);
  const world = jointSymbol('W', joint);
  const parentWorld = new Float64Array(16);
  if (parent < 0) setIdentity(parentWorld);
  else parentWorld.set(worlds.subarray(16 * parent, 16 * parent + 16));
  return {
    joint,
    values: valuesOf(pose, skeleton, joint, compiled.firstDof[joint]),
    factors,
    ownFrom: before.length,
    groups: jointMotion(described.motion).groups ?? 'left',
    localFormula: [local, ' = ', ...factors.flatMap(({ symbol }, i) => (i ? [' · ', ...symbol] : symbol))],
    local: locals.slice(16 * joint, 16 * joint + 16),
    parent,
    parentWorld,
    worldFormula: parent < 0 ? [world, ' = ', local] : [world, ' = ', jointSymbol('W', parent), ' · ', local],
    world: worlds.slice(16 * joint, 16 * joint + 16),
  };
}

function valuesOf(pose: PoseSteps, skeleton: Skeleton, joint: number, first: number): readonly DofStep[] {
  const root = joint === 0 ? rootDofs(skeleton) : [];
  return [
    ...root.map(({ name, unit }, dof) => stepsOfDof(pose, dof, name, unit)),
    ...dofsOf(skeleton.joints[joint].motion).map(({ name, unit }, d) => stepsOfDof(pose, first + d, name, unit)),
  ];
}

/** Those that every joint has. */
function factorsBefore(skeleton: Skeleton, joint: number, dofs: Float64Array): readonly Factor[] {
  const { offset, motion } = skeleton.joints[joint];
  const used = offsetBesideDofs({ offset, motion });
  const isReplaced = used.some((part, k) => part !== offset[k]);
  const factors: Factor[] = [
    {
      symbol: ['T(offset)'],
      law: isReplaced ? 'v + offset; offset is 0 where a position channel replaces it' : 'v + offset',
      matrix: translation(used),
      dofs: [],
    },
  ];
  const root = joint === 0 ? rootDofs(skeleton) : [];
  if (root.length === 0) return factors;
  const symbols = root.flatMap(({ name }, dof) => [dof ? ', ' : '', dofSymbol(name, dof)]);
  const moved: Factor = {
    symbol: ['T(', ...symbols, ')'],
    law: 'v + root translation',
    matrix: translation([dofs[0], dofs[1], dofs[2]]),
    dofs: root.map((_, dof) => dof),
  };
  return [moved, ...factors];
}

function translation([x, y, z]: Vec3): Float64Array {
  return Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1);
}

const LAWS: Readonly<Record<string, string>> = {
  tx: 'x + tx',
  ty: 'y + ty',
  tz: 'z + tz',
  rx: 'y·cos − z·sin, y·sin + z·cos',
  ry: 'z·sin + x·cos, z·cos − x·sin',
  rz: 'x·cos − y·sin, x·sin + y·cos',
  sx: 'x · sx',
  sy: 'y · sy',
  sz: 'z · sz',
};

/** Those of the joint's type: one-DOF matrices, or the whole of J where its matrix is no product of such. */
function ownFactors(skeleton: Skeleton, joint: number, dofs: Float64Array, first: number): readonly Factor[] {
  const { motion } = skeleton.joints[joint];
  const own = dofsOf(motion);
  const names = factorsOf(motion);
  if (names) {
    return names.map((name) => {
      const d = own.findIndex((dof) => dof.name === name);
      const matrix = new Float64Array(16);
      productOf([factorOf(name, 0)]).write(dofs, first + d, matrix, 0);
      const symbol = [`${name[0].toUpperCase()}${name[1]}(`, dofSymbol(name, first + d), ')'];
      return { symbol, law: LAWS[name], matrix, dofs: [first + d] };
    });
  }
  const matrix = new Float64Array(16);
  jointMotion(motion).write(dofs, first, matrix, 0);
  const axis = axisOf(motion);
  const formula = formulaOf(motion) ?? '';
  return [
    {
      symbol: ['J(', ...own.flatMap(({ name }, d) => [d ? ', ' : '', dofSymbol(name, first + d)]), ')'],
      law: axis ? `${formula}, a = (${direction(axis).map(rounded).join(', ')})` : formula,
      matrix,
      dofs: own.map((_, d) => first + d),
    },
  ];
}

function rounded(value: number): string {
  return String(Number(value.toFixed(3)) + 0).replace('-', '−');
}

/** L of the factors, in the order in which evaluation multiplies. */
export function productOfFactors({ factors, ownFrom, groups }: JointSteps): Float64Array {
  const own = factors.slice(ownFrom).map(({ matrix }) => matrix);
  const fold = groups === 'left' ? fromLeft(own) : fromRight(own);
  return fromRight([...factors.slice(0, ownFrom).map(({ matrix }) => matrix), fold]);
}

function fromLeft(matrices: readonly Float64Array[]): Float64Array {
  return matrices.reduce(product, identity());
}

function fromRight(matrices: readonly Float64Array[]): Float64Array {
  return matrices.reduceRight((right, left) => product(left, right), identity());
}

function product(a: Float64Array, b: Float64Array): Float64Array {
  const out = new Float64Array(16);
  multiplyAffine(a, 0, b, 0, out, 0);
  return out;
}

function identity(): Float64Array {
  const out = new Float64Array(16);
  setIdentity(out);
  return out;
}

/**
 * The frames that the factors lead through, from the parent's to the joint's: W of the parent · F₁ … F_k. One more than
 * there are factors; the last is W.
 */
export function framesOf({ factors, parentWorld, world }: JointSteps): readonly Float64Array[] {
  const frames = [parentWorld];
  for (const { matrix } of factors) frames.push(product(frames[frames.length - 1], matrix));
  frames[frames.length - 1] = world;
  return frames;
}
