import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { blendMorphs, compileSkin, deform } from '../../../src/evaluate/skin/deform.ts';
import { type Character, shownSkin } from '../../../src/model/document.ts';
import type { Morph } from '../../../src/model/morph.ts';
import { oneSurface, type Skin, vertexCount } from '../../../src/model/skin.ts';
import { vertexStepper } from '../../../src/teaching/steps/vertex-steps.ts';
import { describeShared } from '../../helpers/shared.ts';
import { characterOf, OWN, SHARED } from '../lesson-files.ts';

describe('the steps of vertices of our examples', () => {
  it.each(Object.entries(OWN))('end at the very place and normal that are drawn: %s', (_, files) => {
    expectDrawn(characterOf(...files));
  });
});

describeShared('the steps of vertices of the reference files', () => {
  const withSkin = Object.entries(SHARED).filter(([, files]) => files.some((file) => file.endsWith('.skin')));
  it.each(withSkin)('end at the very place and normal that are drawn: %s', (_, files) => {
    expectDrawn(characterOf(...files));
  });

  it('has a row for each of nine attachments', () => {
    const { skins, skeleton } = characterOf(...SHARED.nine);
    if (!skeleton) throw new Error('No skeleton.');
    const world = new Float64Array(16 * skeleton.joints.length).fill(0.5);
    const most = Math.max(
      ...Array.from({ length: vertexCount(skins[0]) }, (_, v) => {
        return vertexStepper(skins[0], [], v)(new Float64Array(0), world).attachments.length;
      }),
    );
    expect(most).toBe(9);
  });
});

const number = fc.double({ min: -50, max: 50, noNaN: true });
const triple = fc.tuple(number, number, number);
const matrix = fc.array(number, { minLength: 12, maxLength: 12 }).map((m) => {
  return [...m.slice(0, 3), 0, ...m.slice(3, 6), 0, ...m.slice(6, 9), 0, ...m.slice(9), 1];
});
const JOINTS = 3;
const attachment = fc.tuple(fc.nat(JOINTS - 1), fc.double({ min: -1, max: 2, noNaN: true }));

describe('the steps of random vertices', () => {
  it('random vertices end at the very place and normal that are drawn, whatever moves them', () => {
    const one = fc.record({
      position: triple,
      normal: triple,
      attached: fc.option(fc.array(attachment, { maxLength: 9 }), { nil: undefined }),
      bindings: fc.array(matrix, { minLength: JOINTS, maxLength: JOINTS }),
      world: fc.option(fc.array(matrix, { minLength: JOINTS, maxLength: JOINTS }), { nil: undefined }),
      morphs: fc.array(fc.record({ to: triple, normal: fc.option(triple), weight: fc.oneof(number, fc.constant(0)) }), {
        maxLength: 4,
      }),
    });
    fc.assert(
      fc.property(one, ({ position, normal, attached, bindings, world, morphs }) => {
        const skin: Skin = {
          name: 'x',
          positions: Float64Array.from(position),
          normals: Float64Array.from(normal),
          triangles: new Uint32Array(0),
          surfaces: oneSurface(new Uint32Array(0)),
          bindings: Float64Array.from(bindings.flat()),
          ...(attached && {
            attachments: {
              start: Uint32Array.of(0, attached.length),
              joints: Uint32Array.from(attached, ([j]) => j),
              weights: Float64Array.from(attached, ([, w]) => w),
            },
          }),
        };
        const targets = morphs.map(({ to, normal: turned }, m): Morph => {
          return { name: `m${m}`, positions: rows(to), normals: rows(turned) };
        });
        const dofs = Float64Array.from([7, ...morphs.map(({ weight }) => weight)]);
        expectSteps(skin, targets, dofs, world && Float64Array.from(world.flat()), [0]);
      }),
      { numRuns: 200 },
    );
  });
});

describe('the steps of a vertex', () => {
  it('goes through the morphs, and leaves out none', () => {
    const skin: Skin = {
      name: 'x',
      positions: Float64Array.of(1, 2, 3),
      normals: Float64Array.of(0, 2, 0),
      triangles: new Uint32Array(0),
      surfaces: oneSurface(new Uint32Array(0)),
      bindings: new Float64Array(0),
    };
    const morphs = [
      { name: 'a', positions: rows([2, 2, 3]), normals: rows(null) },
      { name: 'b', positions: rows([1, 4, 3]), normals: rows([1, 0, 0]) },
    ];
    const steps = vertexStepper(skin, morphs, 0)(Float64Array.of(0.5, 0), undefined);
    expect(steps.morphs).toEqual([
      { morph: 0, weight: 0.5, difference: [1, 0, 0], term: [0.5, 0, 0], sum: [1.5, 2, 3] },
      { morph: 1, weight: 0, difference: [0, 2, 0], term: [0, 0, 0], sum: [1.5, 2, 3] },
    ]);
    expect(steps).toMatchObject({ attachments: [], position: [1.5, 2, 3], normal: [0, 1, 0] });
  });
});

function rows(value: readonly number[] | null) {
  return { indices: Uint32Array.from(value ? [0] : []), values: Float64Array.from(value ?? []) };
}

function expectDrawn(of: Character): void {
  const skin = shownSkin(of);
  const { skeleton, morphs } = of;
  if (!skin || !skeleton) throw new Error('Nothing to deform.');
  const compiled = compileSkeleton(skeleton);
  const dofs = new Float64Array(dofCountOf(of));
  const world = new Float64Array(16 * compiled.jointCount);
  const count = vertexCount(skin);
  const every = Math.max(1, Math.floor(count / 150));
  const vertices = Array.from({ length: Math.ceil(count / every) }, (_, i) => i * every);
  for (const time of [0, 0.37]) {
    poseAt(of, time, dofs);
    worldMatrices(compiled, dofs, world);
    morphs.forEach((_, m) => {
      dofs[dofs.length - morphs.length + m] = 0.3 + m;
    });
    expectSteps(skin, morphs, dofs, world, vertices);
  }
}

function expectSteps(
  skin: Skin,
  morphs: readonly Morph[],
  dofs: Float64Array,
  world: Float64Array | undefined,
  vertices: readonly number[],
): void {
  const compiled = compileSkin(skin);
  const positions = new Float64Array(skin.positions.length);
  const normals = new Float64Array(skin.positions.length);
  blendMorphs(compiled, morphs, dofs, dofs.length - morphs.length, positions, normals);
  deform(compiled, world, positions, normals, positions, normals);
  for (const vertex of vertices) {
    const steps = vertexStepper(skin, morphs, vertex)(dofs, world);
    for (let k = 0; k < 3; k++) {
      // Equal as numbers: 0 and −0 are one.
      const found = [steps.position[k], steps.normal[k]];
      const meant = [positions[3 * vertex + k], normals[3 * vertex + k]];
      if (!found.every((x, i) => x === meant[i])) expect(found, `vertex ${vertex}`).toEqual(meant);
    }
  }
}
