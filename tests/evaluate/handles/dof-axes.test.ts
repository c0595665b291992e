import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type DofAxis, dofAxes } from '../../../src/evaluate/handles/dof-axes.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { invertAffine, multiplyAffine } from '../../../src/math/mat4.ts';
import { cross, scaled, transformPoint, transformVector } from '../../../src/math/vec3.ts';
import { characterDofs } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import { type Motion, type Skeleton, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import { bvhMotion, motion } from '../../formats/arbitraries.ts';
import { joint } from '../../helpers/builders.ts';
import { expectClose } from '../../helpers/close.ts';

/** Central differences of this step, of matrices of about this size. */
const STEP = 1e-5;
const BY_DIFFERENCES = 1e-6;

const value = fc.double({ min: 0.4, max: 2, noNaN: true });
const signed = fc.tuple(value, fc.constantFrom(1, -1)).map(([v, s]) => v * s);
const keepsVolume = (of: Motion) => of.kind === 'scale' && of.mode === 'volume';
const tame = (of: Motion) => of.kind !== 'screw' || Math.abs(of.pitch) < 50;
const posed = fc
  .oneof(motion, bvhMotion)
  .filter((of) => of.kind !== 'quaternion' && tame(of))
  .chain((of) => fc.tuple(fc.constant(of), fc.tuple(...dofsOf(of).map(() => (keepsVolume(of) ? value : signed)))));

/** Turned, moved, twice as large; mirrored or not. */
const placementOf = (mirror: 1 | -1) => Float64Array.of(0, 2 * mirror, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, -3, 1, 1);

/** A ball, then the joint. */
function rigOf(of: Motion, values: readonly number[], asRoot: boolean) {
  const limits = values.map(() => UNLIMITED);
  const own = { motion: of, limits, pose: values, offset: [0.3, 1.1, -0.4] as const };
  const skeleton: Skeleton = {
    name: 'rig',
    joints: asRoot ? [joint(-1, own)] : [joint(-1, { offset: [0, 0.5, 0] }), joint(0, own)],
  };
  const count = characterDofs(skeleton, []).length;
  const dofs = new Float64Array(count);
  dofs.set(values, count - values.length);
  if (!asRoot) dofs.set([0.2, -0.1, 0.4, 0.7, -0.5, 0.3]);
  return { skeleton, dofs, joint: skeleton.joints.length - 1 };
}

function worldOf(skeleton: Skeleton, dofs: Float64Array): Float64Array {
  const world = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), dofs, world);
  return world;
}

/** The joint's matrix in the world, and how fast it changes with a DOF. */
function slopeOf(skeleton: Skeleton, index: number, dofs: Float64Array, placement: Float64Array, dof: number) {
  const at = (by: number) => {
    const changed = dofs.slice();
    changed[dof] += by;
    const out = new Float64Array(16);
    multiplyAffine(placement, 0, worldOf(skeleton, changed), 16 * index, out, 0);
    return out;
  };
  const [back, now, ahead] = [at(-STEP), at(0), at(STEP)];
  return { now, slope: ahead.map((v, i) => (v - back[i]) / (2 * STEP)) };
}

/** How a point of the world that the joint carries moves. */
function velocityAt(now: Float64Array, slope: Float64Array, point: readonly [number, number, number]) {
  const inverse = new Float64Array(16);
  invertAffine(now, 0, inverse, 0);
  return transformPoint(slope, transformPoint(inverse, point));
}

function check(axis: DofAxis, now: Float64Array, slope: Float64Array, stretches: boolean): void {
  const { kind, centre, reach, arm } = axis;
  const along = axis.axis;
  if (kind === 'turn') {
    // The axis stays: what lies on it goes along it at most.
    const atCentre = velocityAt(now, slope, centre);
    expectClose(cross(atCentre, along), [0, 0, 0], BY_DIFFERENCES, 'off the axis');
    const further = velocityAt(now, slope, [centre[0] + along[0], centre[1] + along[1], centre[2] + along[2]]);
    expectClose(further, atCentre, BY_DIFFERENCES, 'along the axis');
    if (stretches) return;
    // And what lies beside it turns about it by the right-hand rule.
    const aside = cross(along, Math.abs(along[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0]);
    const there = velocityAt(now, slope, [centre[0] + aside[0], centre[1] + aside[1], centre[2] + aside[2]]);
    const expected = cross(along, aside);
    expectClose(
      there,
      [0, 1, 2].map((k) => atCentre[k] + expected[k]),
      BY_DIFFERENCES,
      'around the axis',
    );
  } else if (kind === 'slide') {
    expectClose(velocityAt(now, slope, centre), scaled(along, reach), BY_DIFFERENCES, 'slides');
  } else if (kind === 'shear') {
    const unit = [1, 2, 0].map((k) => transformVector(slope, [k === 0 ? 1 : 0, k === 1 ? 1 : 0, k === 2 ? 1 : 0]));
    const moves = unit.find((v) => Math.hypot(...v) > 1e-3);
    expectClose(moves ?? [], scaled(along, reach), BY_DIFFERENCES, 'shears');
    expect(arm).toBeDefined();
  } else {
    // A stretch keeps its line: a point on it goes along it. One that grows has any line.
    const out = velocityAt(now, slope, [centre[0] + along[0], centre[1] + along[1], centre[2] + along[2]]);
    const atCentre = velocityAt(now, slope, centre);
    const difference = [0, 1, 2].map((k) => out[k] - atCentre[k]) as [number, number, number];
    expectClose(cross(difference, along), [0, 0, 0], BY_DIFFERENCES, 'off the line');
    expect(Math.hypot(...difference)).toBeGreaterThan(0);
  }
}

describe('the axes of a joint’s DOFs', () => {
  it('the axes of a joint’s DOFs are those about and along which it moves, for every kind of joint', () => {
    fc.assert(
      fc.property(posed, fc.boolean(), fc.constantFrom(1 as const, -1 as const), ([of, values], asRoot, mirror) => {
        const { skeleton, dofs, joint: index } = rigOf(of, values, asRoot);
        const placement = placementOf(mirror);
        const axes = dofAxes(skeleton, index, dofs, worldOf(skeleton, dofs), placement);
        const { firstDof, motions } = compileSkeleton(skeleton);
        const own = values.map((_, d) => firstDof[index] + d);
        // Of a root its translation comes first, unless it has its own.
        expect(axes.map(({ dof }) => dof)).toEqual(asRoot ? [...dofs.keys()] : own);
        for (const axis of axes) {
          const { now, slope } = slopeOf(skeleton, index, dofs, placement, axis.dof);
          check(axis, now, slope, motions[index].stretches ?? false);
        }
      }),
      { numRuns: 300 },
    );
  });

  it('the axes of a joint’s DOFs are gimbal rings: what is applied first is turned by what comes after', () => {
    const { skeleton, dofs, joint: index } = rigOf({ kind: 'ball', order: 'xyz' }, [0.3, 0.5, 0.7], true);
    const placement = Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    const [, , , rx, ry, rz] = dofAxes(skeleton, index, dofs, worldOf(skeleton, dofs), placement);
    const [sy, cy, sz, cz] = [Math.sin(0.5), Math.cos(0.5), Math.sin(0.7), Math.cos(0.7)];
    expectClose(rz.axis, [0, 0, 1], BY_DIFFERENCES);
    expectClose(ry.axis, [-sz, cz, 0], BY_DIFFERENCES);
    expectClose(rx.axis, [cy * cz, cy * sz, -sy], BY_DIFFERENCES);
  });

  it('the axes of a joint’s DOFs have a direction across them that the DOF itself does not turn', () => {
    const zeroAt = (angle: number) => {
      const { skeleton, dofs, joint: index } = rigOf({ kind: 'hinge', axis: [1, 2, 3] }, [angle], false);
      return dofAxes(skeleton, index, dofs, worldOf(skeleton, dofs), placementOf(1))[0];
    };
    const [a, b] = [zeroAt(0.2), zeroAt(1.4)];
    expectClose(a.zero ?? [], b.zero ?? [0], BY_DIFFERENCES);
    expectClose([(a.zero ?? [1, 1, 1]).reduce((sum, v, k) => sum + v * a.axis[k], 0)], [0], BY_DIFFERENCES);
  });

  it('axes of the root’s DOFs include its translation, and no parts of a quaternion', () => {
    const { skeleton, dofs } = rigOf({ kind: 'quaternion' }, [0, 0, 0.6, 0.8], true);
    const axes = dofAxes(skeleton, 0, dofs, worldOf(skeleton, dofs), placementOf(1));
    expect(axes.map(({ name, kind, hue }) => [name, kind, hue])).toEqual([
      ['tx', 'slide', 0],
      ['ty', 'slide', 1],
      ['tz', 'slide', 2],
    ]);
  });

  it('axes of DOFs have the colour of the main axis they rotate about, and none if they are oblique', () => {
    const hueAbout = (axis: readonly [number, number, number]) => {
      const { skeleton, dofs, joint: index } = rigOf({ kind: 'hinge', axis }, [0], false);
      return dofAxes(skeleton, index, dofs, worldOf(skeleton, dofs), placementOf(1))[0].hue;
    };
    expect(hueAbout([0, -1, 0])).toBe(1);
    expect(hueAbout([1, 1, 0.5])).toBe('other');
  });

  it('leave out what has no length left', () => {
    const { skeleton, dofs, joint: index } = rigOf({ kind: 'compound', dofs: ['sx', 'tx', 'ty'] }, [0, 1, 1], true);
    const axes = dofAxes(skeleton, index, dofs, worldOf(skeleton, dofs), placementOf(1));
    expect(axes.map(({ name }) => name)).toEqual(['tx', 'ty', 'tz', 'sx', 'ty']);
  });
});
