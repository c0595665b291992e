import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { adoptSkinFacts, boxOf, posedBounds, skinBounds, skinFacts } from '../../../src/evaluate/skin/bounds.ts';
import { blendMorphs, compileSkin, deform, skinMatrices } from '../../../src/evaluate/skin/deform.ts';
import { normalsOf } from '../../../src/evaluate/skin/normals.ts';
import type { Morph } from '../../../src/model/morph.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import type { Skin } from '../../../src/model/skin.ts';
import { joint, morph, skin } from '../../helpers/builders.ts';
import { referenceMorph, referenceSkeleton, referenceSkin } from '../../helpers/reference.ts';
import { describeShared } from '../../helpers/shared.ts';

/** The box from the joints, and the one around every deformed vertex. */
function boxes(model: Skin, skeleton: Skeleton | undefined, dofs: Float64Array, morphs: readonly Morph[] = []) {
  const compiled = compileSkin(model);
  const weightOffset = dofs.length - morphs.length;
  let world: Float64Array | undefined;
  let matrices: Float64Array | undefined;
  if (skeleton) {
    const bones = compileSkeleton(skeleton);
    world = new Float64Array(16 * bones.jointCount);
    worldMatrices(bones, dofs, world);
    matrices = new Float64Array(16 * compiled.matrixCount);
    skinMatrices(compiled, world, matrices);
  }
  const bounds = new Float64Array(6);
  posedBounds(skinBounds(model, morphs), matrices, dofs, weightOffset, bounds);
  const positions = new Float64Array(model.positions.length);
  const normals = new Float64Array(model.positions.length);
  blendMorphs(compiled, morphs, dofs, weightOffset, positions, normals);
  deform(compiled, world, positions, normals, positions, normals);
  const exact = new Float64Array(6);
  boxOf(positions, exact);
  return { bounds, exact };
}

/** Numbers so small that they have few digits left, of which rounding takes more than its share. */
const DENORMAL = 1e-300;

function expectHolds({ bounds, exact }: ReturnType<typeof boxes>): void {
  for (let i = 0; i < 3; i++) {
    expect(bounds[i]).toBeLessThanOrEqual(exact[i] + DENORMAL);
    expect(bounds[i + 3]).toBeGreaterThanOrEqual(exact[i + 3] - DENORMAL);
  }
}

const angle = fc.double({ min: -4, max: 4, noNaN: true });
const poseOf = (skeleton: Skeleton, morphs: number) => {
  const count = 3 + compileSkeleton(skeleton).dofCount + morphs;
  return fc.array(angle, { minLength: count, maxLength: count }).map((list) => Float64Array.from(list));
};

describeShared('bounds of the reference skins', () => {
  const data = (name: string) => `data/${name}`;
  it.each([
    ['cse169/wasp.skel', 'cse169/wasp.skin', []],
    ['cse169/wasp_p1.skel', 'cse169/wasp_p2.skin', []],
    ['cse169/tube.skel', 'cse169/tube_smooth.skin', []],
    ['cse169/head.skel', 'cse169/head.skin', ['cse169/head1.morph', 'cse169/head2.morph']],
    ['synthetic/six.skel', 'synthetic/six.skin', []],
    ['synthetic/nine.skel', 'synthetic/nine.skin', []],
  ] as const)('hold every vertex of %s with %s at any pose', (skel, path, targets) => {
    const skeleton = referenceSkeleton(data(skel));
    const model = referenceSkin(data(path));
    const morphs = targets.map((m) => referenceMorph(data(m)));
    fc.assert(
      fc.property(poseOf(skeleton, morphs.length), (dofs) => {
        expectHolds(boxes(model, skeleton, dofs, morphs));
        expectHolds(boxes(model, undefined, dofs, morphs));
      }),
      { numRuns: 40 },
    );
  });

  it('bounds of the reference skins are not much larger than they must be', () => {
    const skeleton = referenceSkeleton(data('cse169/wasp.skel'));
    const dofs = new Float64Array(3 + compileSkeleton(skeleton).dofCount);
    const { bounds, exact } = boxes(referenceSkin(data('cse169/wasp.skin')), skeleton, dofs);
    for (let i = 0; i < 3; i++) {
      expect(bounds[i + 3] - bounds[i]).toBeLessThan(1.5 * (exact[i + 3] - exact[i]));
    }
  });
});

const coordinate = fc.oneof(angle, fc.double({ min: -1e6, max: 1e6, noNaN: true }));
const triple = fc.tuple(coordinate, coordinate, coordinate);
const weight = fc.oneof(
  fc.constantFrom(0, 1, 0.5),
  fc.double({ min: 0, max: 3, noNaN: true }),
  fc.double({ min: -2, max: 2, noNaN: true }),
);
const JOINTS = 3;
const arm: Skeleton = { name: 'arm', joints: [joint(-1), joint(0, { offset: [3, 0, 0] }), joint(1)] };
const randomSkin = fc
  .array(
    fc.record({
      at: triple,
      attachments: fc.array(fc.tuple(fc.nat(JOINTS - 1), weight), { maxLength: 5 }),
      morphed: fc.array(triple, { maxLength: 2 }),
    }),
    { minLength: 1, maxLength: 12 },
  )
  .chain((vertices) => fc.tuple(fc.constant(vertices), fc.infiniteStream(fc.double({ min: 0.2, max: 2, noNaN: true }))))
  .map(([vertices, sizes]) => {
    const start = [0];
    for (const v of vertices) start.push(start[start.length - 1] + v.attachments.length);
    const bindings = new Float64Array(16 * JOINTS);
    for (let b = 0; b < bindings.length; b += 16) {
      for (const d of [0, 5, 10]) bindings[b + d] = sizes.next().value ?? 1;
      bindings[b + 15] = 1;
    }
    const attached = vertices.flatMap((v) => v.attachments);
    const model = skin('random', 0, {
      positions: Float64Array.from(vertices.flatMap((v) => v.at)),
      normals: new Float64Array(3 * vertices.length),
      attachments: {
        start: Uint32Array.from(start),
        joints: Uint32Array.from(attached, ([j]) => j),
        weights: Float64Array.from(attached, ([, w]) => w),
      },
      bindings,
    });
    const moved = vertices.flatMap((v, index) => v.morphed.map((to) => ({ index, to })));
    const target: Morph = {
      name: 'm',
      positions: {
        indices: Uint32Array.from(moved, (m) => m.index),
        values: Float64Array.from(moved.flatMap((m) => m.to)),
      },
      normals: { indices: new Uint32Array(0), values: new Float64Array(0) },
    };
    return { model, target };
  });

describe('bounds', () => {
  it('hold every vertex of any skin: any weights, negative and 0 too, none at all, morphs, far from the origin', () => {
    fc.assert(
      fc.property(randomSkin, poseOf(arm, 1), ({ model, target }, dofs) => {
        expectHolds(boxes(model, arm, dofs, [target]));
        expectHolds(boxes(model, undefined, dofs, [target]));
        const { attachments: _none, ...rigid } = model;
        expectHolds(boxes(rigid, arm, dofs, [target]));
      }),
      { numRuns: 150 },
    );
  });

  it('bounds are tight for a skin that moves as one', () => {
    const dofs = Float64Array.of(10, 20, 30, 0, 0, 0);
    const { bounds, exact } = boxes(skin(), { name: 's', joints: [joint(-1)] }, dofs);
    for (let i = 0; i < 6; i++) expect(bounds[i]).toBeCloseTo(exact[i], 10);
  });

  it('leave a joint out that a vertex is attached to with weight 0', () => {
    const attachments = {
      start: Uint32Array.of(0, 2, 4, 6),
      joints: Uint32Array.of(0, 1, 0, 1, 0, 1),
      weights: Float64Array.of(1, 0, 1, 0, 1, 0),
    };
    const far: Skeleton = { name: 's', joints: [joint(-1, { offset: [0, 0, 0] }), joint(0, { offset: [1000, 0, 0] })] };
    expect(boxes(skin('s', 1, { attachments }), far, new Float64Array(9)).bounds[3]).toBeCloseTo(1, 10);
  });

  it('bounds are inverted for a skin without vertices', () => {
    const empty = { start: Uint32Array.of(0), joints: new Uint32Array(0), weights: new Float64Array(0) };
    const none = skin('s', 0, { positions: new Float64Array(0), normals: new Float64Array(0), attachments: empty });
    expect(boxes(none, undefined, new Float64Array(3)).bounds).toEqual(
      Float64Array.of(Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity),
    );
  });

  it('bounds are measured once for a skin and its morphs', () => {
    const model = skin();
    const smile = morph('smile');
    expect(skinBounds(model, [smile])).toBe(skinBounds(model, [smile]));
    expect(skinBounds(model, [smile])).not.toBe(skinBounds(model, []));
    expect(skinBounds(model, [smile]).joints).toBe(skinBounds(model, []).joints);
  });
});

describe('facts of a skin', () => {
  const attachments = {
    start: Uint32Array.of(0, 0, 3, 4),
    joints: Uint32Array.of(0, 1, 1, 1),
    weights: Float64Array.of(0, 0.5, 0.5, 1),
  };
  const { normals: _none, ...bare } = skin('s', 1, { attachments });

  it('count attachments, and the vertices that each joint moves', () => {
    expect(skinFacts(bare)).toMatchObject({ maxAttachments: 3, movedVertices: Uint32Array.of(0, 2) });
    const { attachments: _all, ...rigid } = bare;
    expect(skinFacts(rigid)).toMatchObject({ maxAttachments: 0, movedVertices: Uint32Array.of(3, 0) });
  });

  it('hold normals only where the skin has none', () => {
    expect(skinFacts(bare).normals).toEqual(Float64Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1));
    expect(skinFacts(skin())).not.toHaveProperty('normals');
  });

  it('facts of a skin come through a worker, and are taken over for the copy there', () => {
    const smile = morph('smile', 1);
    const sent = structuredClone({ skin: bare, morphs: [smile], facts: skinFacts(bare, [smile]) });
    expect(sent.facts).toEqual(skinFacts(bare, [smile]));
    adoptSkinFacts(sent.skin, sent.facts, sent.morphs);
    expect(skinFacts(sent.skin).bounds.joints).toBe(sent.facts.bounds.joints);
    expect(normalsOf(sent.skin)).toBe(sent.facts.normals);
    expect(skinBounds(sent.skin, sent.morphs).reaches[0]).toBe(sent.facts.bounds.reaches[0]);
    expect(skinBounds(sent.skin, sent.morphs)).toEqual(skinBounds(bare, [smile]));
  });
});
