import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { clampDofs, compileSkeleton, localMatrices, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { EULER_ORDERS, type EulerOrder, type Skeleton } from '../../src/model/skeleton/skeleton.ts';
import { joint, skeleton } from '../helpers/builders.ts';
import { expectClose, WITHIN } from '../helpers/close.ts';
import { referenceSkeleton } from '../helpers/reference.ts';
import { conformance, describeShared } from '../helpers/shared.ts';

interface FkFile {
  readonly tolerance: { readonly float64: number };
  readonly skeletons: readonly {
    readonly skel: string;
    readonly joint_count: number;
    readonly parents: readonly number[];
    readonly poses: readonly {
      readonly name: string;
      readonly root_translation: readonly number[];
      readonly pose: readonly (readonly number[])[];
      readonly clamped_dofs: number;
      readonly clamped: readonly (readonly number[])[];
      readonly world: readonly (readonly number[])[];
    }[];
  }[];
}

describeShared('forward kinematics against the reference', () => {
  const { tolerance, skeletons } = conformance<FkFile>('skel-fk.json');

  it.each(skeletons)('world matrices of $skel are those of the reference', ({ skel, joint_count, parents, poses }) => {
    const model = referenceSkeleton(skel);
    const compiled = compileSkeleton(model);
    expect(compiled.jointCount).toBe(joint_count);
    expect([...compiled.parent]).toEqual(parents);
    for (const pose of poses) {
      const asked = pose.name === 'file' ? model.joints.flatMap((j) => j.pose) : pose.pose.flat();
      expect(asked).toEqual(pose.pose.flat());
      const dofs = Float64Array.from([...pose.root_translation, ...asked]);
      const before = dofs.slice();
      clampDofs(compiled, dofs);
      expectClose(dofs.subarray(3), pose.clamped.flat(), tolerance.float64, `${pose.name}: clamped`);
      expect([...dofs.subarray(0, 3)]).toEqual(pose.root_translation);
      expect(dofs.filter((value, d) => value !== before[d])).toHaveLength(pose.clamped_dofs);
      const world = new Float64Array(16 * joint_count);
      worldMatrices(compiled, dofs, world);
      expectClose(world, pose.world.flat(), tolerance.float64, `${pose.name}: world matrices`);
    }
  });
});

type Rows = number[][];
/** Written plainly, to be held against: rows of a 4×4 matrix. */
const product = (a: Rows, b: Rows): Rows =>
  a.map((row) => [0, 1, 2, 3].map((c) => row.reduce((sum, x, i) => sum + x * b[i][c], 0)));
const translation = ([x, y, z]: readonly number[]): Rows => [
  [1, 0, 0, x],
  [0, 1, 0, y],
  [0, 0, 1, z],
  [0, 0, 0, 1],
];
const rotation = (axis: string, angle: number): Rows => {
  const [s, c] = [Math.sin(angle), Math.cos(angle)];
  if (axis === 'x')
    return [
      [1, 0, 0, 0],
      [0, c, -s, 0],
      [0, s, c, 0],
      [0, 0, 0, 1],
    ];
  if (axis === 'y')
    return [
      [c, 0, s, 0],
      [0, 1, 0, 0],
      [-s, 0, c, 0],
      [0, 0, 0, 1],
    ];
  return [
    [c, -s, 0, 0],
    [s, c, 0, 0],
    [0, 0, 1, 0],
    [0, 0, 0, 1],
  ];
};
const columns = (m: Rows) => [0, 1, 2, 3].flatMap((c) => m.map((row) => row[c]));

function naiveWorld(model: Skeleton, dofs: Float64Array): number[] {
  const world: Rows[] = [];
  model.joints.forEach(({ offset, parent, motion }, j) => {
    let m = parent < 0 ? translation([...dofs.subarray(0, 3)]) : world[parent];
    m = product(m, translation(offset));
    if (motion.kind !== 'ball') throw new Error('only balls here');
    for (const axis of [...motion.order].reverse()) {
      m = product(m, rotation(axis, dofs[3 + 3 * j + 'xyz'.indexOf(axis)]));
    }
    world.push(m);
  });
  return world.flatMap(columns);
}

const angle = fc.double({ min: -7, max: 7, noNaN: true });
const vec = fc.tuple(angle, angle, angle);
const order = fc.constantFrom<EulerOrder[]>(...EULER_ORDERS);
const anySkeleton = fc
  .array(fc.record({ up: fc.nat(), offset: vec, order }), { minLength: 1, maxLength: 8 })
  .map((list): Skeleton => {
    // A parent on the last joint's path to the root keeps the list in pre-order.
    const path: number[] = [];
    const joints = list.map(({ up, offset, order }, j) => {
      if (j > 0) path.length = 1 + (up % path.length);
      const parent = path.at(-1) ?? -1;
      path.push(j);
      return joint(parent, { offset, motion: { kind: 'ball', order } });
    });
    return { name: 'any', joints };
  });

describe('world matrices', () => {
  it('agree with the plain product of translations and rotations, in any order of axes', () => {
    fc.assert(
      fc.property(anySkeleton, fc.infiniteStream(angle), (model, angles) => {
        const compiled = compileSkeleton(model);
        const dofs = Float64Array.from([...angles.take(3 + compiled.dofCount)]);
        const world = new Float64Array(16 * compiled.jointCount);
        worldMatrices(compiled, dofs, world);
        expectClose(world, naiveWorld(model, dofs), WITHIN.rounding);
      }),
    );
  });

  it('world matrices are products of the local ones', () => {
    const compiled = compileSkeleton(skeleton(3));
    const dofs = Float64Array.from({ length: 12 }, (_, d) => d / 7);
    const local = new Float64Array(48);
    const world = new Float64Array(48);
    localMatrices(compiled, dofs, local);
    worldMatrices(compiled, dofs, world);
    expect(world.subarray(0, 16)).toEqual(local.subarray(0, 16));
    const rows = (m: Float64Array, j: number) =>
      [0, 1, 2, 3].map((r) => [0, 1, 2, 3].map((c) => m[16 * j + 4 * c + r]));
    expectClose(world.subarray(32), columns(product(rows(world, 1), rows(local, 2))), WITHIN.rounding);
  });

  it('put the root where its offset and translation say', () => {
    const world = new Float64Array(16);
    worldMatrices(compileSkeleton(skeleton(1)), Float64Array.of(10, 20, 30, 0, 0, 0), world);
    expect([...world.subarray(12, 15)]).toEqual([10, 21, 30]);
  });
});

describe('a compiled skeleton', () => {
  it('a compiled skeleton is made once', () => {
    const model = skeleton();
    expect(compileSkeleton(model)).toBe(compileSkeleton(model));
  });

  it('knows where subtrees end and DOFs begin', () => {
    const compiled = compileSkeleton({ name: 's', joints: [joint(-1), joint(0), joint(1), joint(0)] });
    expect([...compiled.subtreeEnd]).toEqual([4, 3, 3, 4]);
    expect([...compiled.firstDof]).toEqual([3, 6, 9, 12, 15]);
  });
});

describe('clamping', () => {
  const limits = [
    { min: -1, max: 1 },
    { min: 2, max: -2 },
    { min: 0.5, max: 0.5 },
  ];
  const compiled = compileSkeleton({ name: 's', joints: [joint(-1, { limits })] });

  it('holds limits, takes crossed ones for none, and leaves root translation and morphs', () => {
    const dofs = Float64Array.of(50, 60, 70, 4, 4, 4, 8);
    clampDofs(compiled, dofs);
    expect([...dofs]).toEqual([50, 60, 70, 1, 4, 0.5, 8]);
  });
});
