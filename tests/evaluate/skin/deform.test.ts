import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { clampDofs, compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { poseAt } from '../../../src/evaluate/pose.ts';
import { boxOf } from '../../../src/evaluate/skin/bounds.ts';
import { blendMorphs, compileSkin, deform } from '../../../src/evaluate/skin/deform.ts';
import { computeNormals, normalsOf } from '../../../src/evaluate/skin/normals.ts';
import type { Morph } from '../../../src/model/morph.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import type { Skin } from '../../../src/model/skin.ts';
import { character, morph, skin } from '../../helpers/builders.ts';
import { expectClose, WITHIN } from '../../helpers/close.ts';
import { referenceMorph, referenceSkeleton, referenceSkin, referenceTake } from '../../helpers/reference.ts';
import { conformance, describeShared } from '../../helpers/shared.ts';

interface Expected {
  readonly aabb: { readonly min: readonly number[]; readonly max: readonly number[] };
  readonly shortest_normal_sum: number;
  readonly positions: readonly (readonly number[])[];
  readonly normals: readonly (readonly number[])[];
}
interface Posed {
  readonly root_translation: readonly number[];
  readonly pose: readonly (readonly number[])[];
}
interface SkinFile {
  readonly tolerance: { readonly float64: number };
  readonly cases: readonly {
    readonly skel: string;
    readonly skin: string;
    readonly vertex_count: number;
    readonly triangle_count: number;
    readonly max_influences: number;
    readonly poses: readonly (Expected & Posed & { readonly name: string; readonly vertices: readonly number[] })[];
  }[];
}
interface MorphFile {
  readonly tolerance: { readonly float64: number };
  readonly cases: readonly (Posed & {
    readonly skel: string;
    readonly skin: string;
    readonly morphs: readonly string[];
    readonly vertices: readonly number[];
    readonly blends: readonly (Expected & {
      readonly weights: readonly number[];
      readonly blended_positions: readonly (readonly number[])[];
      readonly blended_normals: readonly (readonly number[])[];
    })[];
  })[];
}
interface AnimFile {
  readonly tolerance: { readonly float64: number };
  readonly cases: readonly {
    readonly skel: string;
    readonly skin?: string;
    readonly anim: string;
    readonly frames: readonly (Expected & { readonly time: number; readonly vertices: readonly number[] })[];
  }[];
}

const pick = (list: Float64Array, vertices: readonly number[]) =>
  vertices.flatMap((v) => [list[3 * v], list[3 * v + 1], list[3 * v + 2]]);

/** A skin at a pose, morphed first. Buffers start as NaN: everything must be written. */
function posed(model: Skin, skeleton: Skeleton | undefined, dofs: Float64Array, morphs: readonly Morph[] = []) {
  const compiled = compileSkin(model);
  const blended = { positions: model.positions.map(() => NaN), normals: model.positions.map(() => NaN) };
  const out = { positions: model.positions.map(() => NaN), normals: model.positions.map(() => NaN) };
  let world: Float64Array | undefined;
  if (skeleton) {
    const bones = compileSkeleton(skeleton);
    clampDofs(bones, dofs);
    world = new Float64Array(16 * bones.jointCount);
    worldMatrices(bones, dofs, world);
  }
  blendMorphs(compiled, morphs, dofs, dofs.length - morphs.length, blended.positions, blended.normals);
  deform(compiled, world, blended.positions, blended.normals, out.positions, out.normals);
  return { blended, ...out };
}

function expectPosed(
  got: ReturnType<typeof posed>,
  vertices: readonly number[],
  expected: Expected,
  tolerance: number,
) {
  const box = new Float64Array(6);
  boxOf(got.positions, box);
  expectClose(box, [...expected.aabb.min, ...expected.aabb.max], tolerance, 'box');
  expectClose(pick(got.positions, vertices), expected.positions.flat(), tolerance, 'positions');
  const relaxed = tolerance / Math.min(1, expected.shortest_normal_sum);
  expectClose(pick(got.normals, vertices), expected.normals.flat(), relaxed, 'normals');
}

describeShared('skins against the reference', () => {
  for (const name of ['skin-deform.json', 'skin-many-influences.json']) {
    const { tolerance, cases } = conformance<SkinFile>(name);
    it.each(cases)(
      `vertices of $skin are those of ${name}`,
      ({ skel, skin: path, poses, vertex_count, triangle_count, max_influences }) => {
        const model = referenceSkin(path);
        expect(model.positions).toHaveLength(3 * vertex_count);
        expect(model.triangles).toHaveLength(3 * triangle_count);
        const widths = model.attachments?.start.map((s, v, all) => (all[v + 1] ?? s) - s) ?? [];
        expect(Math.max(...widths)).toBe(max_influences);
        for (const pose of poses) {
          const dofs = Float64Array.from([...pose.root_translation, ...pose.pose.flat()]);
          expectPosed(posed(model, referenceSkeleton(skel), dofs), pose.vertices, pose, tolerance.float64);
        }
      },
    );
  }

  const morphFile = conformance<MorphFile>('morph.json');
  it.each(morphFile.cases)(
    'vertices of $skin with $morphs are those of the reference',
    ({ skel, skin: path, morphs, vertices, blends, ...pose }) => {
      const model = referenceSkin(path);
      const targets = morphs.map(referenceMorph);
      for (const blend of blends) {
        const dofs = Float64Array.from([...pose.root_translation, ...pose.pose.flat(), ...blend.weights]);
        const got = posed(model, referenceSkeleton(skel), dofs, targets);
        const within = morphFile.tolerance.float64;
        expectClose(pick(got.blended.positions, vertices), blend.blended_positions.flat(), within, 'blended positions');
        expectClose(pick(got.blended.normals, vertices), blend.blended_normals.flat(), within, 'blended normals');
        expectPosed(got, vertices, blend, within);
      }
    },
  );

  const animFile = conformance<AnimFile>('anim-pose.json');
  it.each(animFile.cases.filter((c) => c.skin))(
    'vertices of $skin playing $anim are those of the reference',
    ({ skel, skin: path = '', anim, frames }) => {
      const played = character({ skeleton: referenceSkeleton(skel), takes: [referenceTake(anim)], shownTake: 0 });
      const model = referenceSkin(path);
      for (const frame of frames) {
        const dofs = new Float64Array(played.pose.length);
        poseAt(played, frame.time, dofs);
        expectPosed(posed(model, played.skeleton, dofs), frame.vertices, frame, animFile.tolerance.float64);
      }
    },
  );
});

const translated = (x: number, y: number, z: number) => Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1);
const scaled = (x: number, y: number, z: number) => Float64Array.of(x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1);

function run(model: Skin, world: Float64Array | undefined) {
  const compiled = compileSkin(model);
  const positions = new Float64Array(model.positions.length);
  const normals = new Float64Array(model.positions.length);
  deform(compiled, world, model.positions, compiled.normals, positions, normals);
  return { positions: [...positions], normals: [...normals] };
}

describe('deforming', () => {
  const tilted = Float64Array.of(0, 0, 3, 0, 2, 0, 1, 0, 0);

  it('leaves a skin without a skeleton as it is, with normals of length 1', () => {
    const { positions, normals } = run(skin('s', 0, { normals: tilted }), undefined);
    expect(positions).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
    expect(normals).toEqual([0, 0, 1, 0, 1, 0, 1, 0, 0]);
  });

  it('leaves a vertex without attachments where it is', () => {
    const attachments = { start: Uint32Array.of(0, 0, 1, 1), joints: Uint32Array.of(0), weights: Float64Array.of(1) };
    const { positions, normals } = run(skin('s', 0, { attachments, normals: tilted }), translated(5, 6, 7));
    expect(positions).toEqual([0, 0, 0, 6, 6, 7, 0, 1, 0]);
    expect(normals).toEqual([0, 0, 1, 0, 1, 0, 1, 0, 0]);
  });

  it('attaches a skin without attachments to the root, through its binding if there is one', () => {
    const { attachments: _none, ...bare } = skin();
    expect(run({ ...bare, bindings: new Float64Array(0) }, translated(5, 6, 7)).positions).toEqual([
      5, 6, 7, 6, 6, 7, 5, 7, 7,
    ]);
    expect(run({ ...bare, bindings: translated(5, 0, 0) }, translated(5, 6, 7)).positions).toEqual([
      0, 6, 7, 1, 6, 7, 0, 7, 7,
    ]);
  });

  it('deforming uses weights as given', () => {
    const attachments = { ...(skin().attachments ?? fail()), weights: Float64Array.of(0.5, 2, 0) };
    expect(run(skin('s', 0, { attachments }), translated(2, 0, 0)).positions).toEqual([1, 0, 0, 6, 0, 0, 0, 0, 0]);
  });

  it('deforming turns normals by the inverse transpose', () => {
    const slanted = Float64Array.of(1, 1, 0, 1, 1, 0, 1, 1, 0);
    const { normals } = run(skin('s', 0, { normals: slanted }), scaled(2, 1, 1));
    expectClose(normals.slice(0, 3), [1 / Math.sqrt(5), 2 / Math.sqrt(5), 0], WITHIN.rounding);
  });

  it('deforming keeps normals finite where a joint flattens, or contributions cancel out', () => {
    expect(run(skin(), scaled(1, 0, 1)).normals).toEqual([0, 0, 1, 0, 0, 1, 0, 0, 1]);
    expect(run(skin(), scaled(0, 0, 0)).normals).toEqual([0, 0, 1, 0, 0, 1, 0, 0, 1]);
    const attachments = { ...(skin().attachments ?? fail()), weights: Float64Array.of(0, 0, 0) };
    expect(run(skin('s', 0, { attachments, normals: new Float64Array(9) }), translated(1, 1, 1)).normals).toEqual([
      0, 1, 0, 0, 1, 0, 0, 1, 0,
    ]);
  });

  it('deforming may write over its input', () => {
    const compiled = compileSkin(skin());
    const positions = compiled.skin.positions.slice();
    const normals = compiled.normals.slice();
    deform(compiled, translated(1, 2, 3), positions, normals, positions, normals);
    expect([...positions]).toEqual([1, 2, 3, 2, 2, 3, 1, 3, 3]);
  });

  it('deforming keeps in place what hangs on joints that the skeleton does not have', () => {
    expect(run(skin('s', 1), translated(5, 5, 5)).positions).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  });

  it('deforming is compiled once', () => {
    const model = skin();
    expect(compileSkin(model)).toBe(compileSkin(model));
  });
});

describe('blending morphs', () => {
  it('adds each target’s difference from the base, by weight', () => {
    const model = compileSkin(skin());
    const positions = new Float64Array(9);
    const normals = new Float64Array(9);
    // Vertex 1 of the base is at (1, 0, 0), both targets put it at (0, 0, 5).
    const targets = [morph('a', 1), morph('b', 1)];
    blendMorphs(model, targets, Float64Array.of(99, 0.5, -1), 1, positions, normals);
    expect([...positions]).toEqual([0, 0, 0, 1.5, 0, -2.5, 0, 1, 0]);
    expect(normals).toEqual(model.normals);
  });

  it('passes over rows for vertices that the skin does not have', () => {
    const positions = new Float64Array(9);
    blendMorphs(compileSkin(skin()), [morph('a', 77)], Float64Array.of(1), 0, positions, new Float64Array(9));
    expect(positions).toEqual(skin().positions);
  });
});

describe('computed normals', () => {
  it('weigh each triangle by its area', () => {
    // Two triangles share the first edge: one in the xy plane, the other, three times as large, in the xz plane.
    const positions = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -3, 9, 9, 9);
    const normals = computeNormals(positions, Uint32Array.of(0, 1, 2, 0, 1, 3));
    const shared = [0, 3 / Math.sqrt(10), 1 / Math.sqrt(10)];
    expectClose(normals, [...shared, ...shared, 0, 0, 1, 0, 1, 0, 0, 1, 0], WITHIN.rounding);
  });

  it('computed normals have length 1 on any mesh, and are computed once', () => {
    const numbers = fc.array(fc.double({ noNaN: true, noDefaultInfinity: true }), { minLength: 15, maxLength: 15 });
    const indices = fc.array(fc.nat(4), { maxLength: 12 });
    fc.assert(
      fc.property(numbers, indices, (positions, triangles) => {
        const { normals: _none, ...bare } = skin();
        const model = { ...bare, positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
        const normals = normalsOf(model);
        expect(normalsOf(model)).toBe(normals);
        for (let o = 0; o < 15; o += 3)
          expect(Math.hypot(normals[o], normals[o + 1], normals[o + 2])).toBeCloseTo(1, 12);
      }),
    );
  });
});

function fail(): never {
  throw new Error('the builder’s skin has attachments');
}
