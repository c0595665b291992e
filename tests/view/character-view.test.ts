import { Box3, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { type Character, DEFAULT_PLACEMENT } from '../../src/model/document.ts';
import { DEFAULT_DISPLAY } from '../../src/model/session.ts';
import { filePose } from '../../src/model/skeleton/dofs.ts';
import type { BvhChannel } from '../../src/model/skeleton/skeleton.ts';
import { CharacterView } from '../../src/view/character-view.ts';
import { DrawnSkins } from '../../src/view/skin/drawn-skins.ts';
import { character, morph, skeleton, skin, takeOfValues } from '../helpers/builders.ts';
import { bvhJoint, captureOf } from '../helpers/bvh.ts';
import { expectClose, WITHIN } from '../helpers/close.ts';
import { heatValuesOf } from '../helpers/heat-values.ts';
import { referenceMorph, referenceSkeleton, referenceSkin, referenceTake } from '../helpers/reference.ts';
import { conformance, describeShared } from '../helpers/shared.ts';

interface Posed {
  readonly root_translation: readonly number[];
  readonly pose: readonly (readonly number[])[];
}
interface Expected {
  readonly aabb: { readonly min: readonly number[]; readonly max: readonly number[] };
  readonly positions: readonly (readonly number[])[];
}
interface SkinFile {
  readonly cases: readonly {
    readonly skel: string;
    readonly skin: string;
    readonly poses: readonly (Posed & Expected & { readonly name: string; readonly vertices: readonly number[] })[];
  }[];
}
interface MorphFile {
  readonly cases: readonly (Posed & {
    readonly skel: string;
    readonly skin: string;
    readonly morphs: readonly string[];
    readonly vertices: readonly number[];
    readonly blends: readonly (Expected & { readonly weights: readonly number[] })[];
  })[];
}
interface AnimFile {
  readonly cases: readonly {
    readonly skel: string;
    readonly skin?: string;
    readonly anim: string;
    readonly frames: readonly (Expected & {
      readonly time: number;
      readonly root_translation: readonly number[];
      readonly clamped: readonly (readonly number[])[];
      readonly world: readonly (readonly number[])[];
      readonly vertices: readonly number[];
    })[];
  }[];
}

function shown(what: Character, timeSeconds = 0): CharacterView {
  const view = new CharacterView(new DrawnSkins());
  view.show(what, DEFAULT_DISPLAY, undefined);
  view.seek(timeSeconds);
  return view;
}

/** Compares deformed positions and their bounding box with the reference, in floats as on the GPU. */
function expectVertices(view: CharacterView, expected: Expected, vertices: readonly number[]): void {
  const all = view.vertices();
  const largest = all.reduce((most, x) => Math.max(most, Math.abs(x)), 1);
  const got = vertices.flatMap((v) => [...all.subarray(3 * v, 3 * v + 3)]);
  // The file states this tolerance relative to the largest coordinate of the model.
  expectClose(
    got.map((x) => x / largest),
    expected.positions.flat().map((x) => x / largest),
    WITHIN.referenceFloat,
    'positions',
  );
  const box = view.bounds(new Box3());
  const slack = WITHIN.referenceFloat * largest;
  for (const [i, axis] of (['x', 'y', 'z'] as const).entries()) {
    expect(box.min[axis]).toBeLessThanOrEqual(expected.aabb.min[i] + slack);
    expect(box.max[axis]).toBeGreaterThanOrEqual(expected.aabb.max[i] - slack);
  }
}

describeShared('a character in the picture, against the reference', () => {
  for (const file of ['skin-deform.json', 'skin-many-influences.json']) {
    for (const { skel, skin: skinPath, poses } of conformance<SkinFile>(file).cases) {
      for (const { name, root_translation, pose, vertices, ...expected } of poses) {
        it(`skins ${skinPath} at ${name}`, () => {
          const own = referenceSkeleton(skel);
          const set = [...root_translation, ...pose.flat()];
          expectVertices(
            shown(character({ skeleton: own, skins: [referenceSkin(skinPath)], pose: set })),
            expected,
            vertices,
          );
        });
      }
    }
  }

  for (const { skel, skin: skinPath, morphs, root_translation, pose, vertices, blends } of conformance<MorphFile>(
    'morph.json',
  ).cases) {
    for (const { weights, ...expected } of blends) {
      it(`morphs ${skinPath} by ${weights.join(', ')}, then skins it`, () => {
        const own = referenceSkeleton(skel);
        const targets = morphs.map(referenceMorph);
        const set = [...root_translation, ...pose.flat(), ...weights];
        const model = character({ skeleton: own, skins: [referenceSkin(skinPath)], morphs: targets, pose: set });
        expectVertices(shown(model), expected, vertices);
      });
    }
  }

  for (const { skel, skin: skinPath, anim, frames } of conformance<AnimFile>('anim-pose.json').cases) {
    it(`plays ${anim} through the mixer: DOFs, matrices and vertices, before and past its range too`, () => {
      const own = referenceSkeleton(skel);
      const skins = skinPath ? [referenceSkin(skinPath)] : [];
      const view = shown(character({ skeleton: own, skins, takes: [referenceTake(anim)], shownTake: 0 }));
      for (const { time, root_translation, clamped, world, vertices, ...expected } of frames) {
        view.seek(time);
        expectClose(view.dofs, [...root_translation, ...clamped.flat()], WITHIN.reference, `DOFs at ${time}`);
        expectClose(view.worldMatrices, world.flat(), WITHIN.reference, `matrices at ${time}`);
        view.bones.forEach((bone, j) => {
          expectClose(bone.matrixWorld.elements, world[j], WITHIN.reference, `bone ${j} at ${time}`);
        });
        if (skinPath) expectVertices(view, expected, vertices);
      }
    });
  }
});

describe('a character in the picture', () => {
  it('a character has bones in their hierarchy, by index, whatever their names', () => {
    const own = skeleton(3);
    const nameless = { ...own, joints: own.joints.map((j) => ({ ...j, name: '' })) };
    const view = shown(character({ skeleton: nameless, pose: filePose(nameless, 0) }));
    const [root, middle, tip] = view.bones;
    expect(middle.parent).toBe(root);
    expect(tip.parent).toBe(middle);
    expect(root.parent).toBe(view.object);
    expect(new Vector3().setFromMatrixPosition(tip.matrixWorld)).toMatchObject({ x: 0, y: 3, z: 0 });
    view.object.updateMatrixWorld(true);
    expect(new Vector3().setFromMatrixPosition(tip.matrixWorld).y).toBe(3);
    expect(new Vector3().setFromMatrixPosition(tip.matrix).y).toBe(1);
  });

  it('rebuilds nothing for an edit of the pose', () => {
    const model = character({ skins: [skin()] });
    const view = shown(model);
    const before = { mesh: view.skinnedMeshes[0], bone: view.bones[0], dofs: view.dofs };
    view.show({ ...model, pose: model.pose.map((_, d) => (d === 0 ? 7 : 0)) }, DEFAULT_DISPLAY, undefined);
    expect(view.skinnedMeshes[0]).toBe(before.mesh);
    expect(view.bones[0]).toBe(before.bone);
    expect(view.dofs).toBe(before.dofs);
    expect(view.dofs[0]).toBe(7);
    expect(view.vertices()[0]).toBe(7);
  });

  it('a character in the picture keeps its mesh when only the skeleton changes, and follows the new one', () => {
    const model = character({ skins: [skin('hero', 1)] });
    const view = shown(model);
    const mesh = view.skinnedMeshes[0];
    const own = skeleton(2);
    const longer = { ...own, joints: own.joints.map((j) => ({ ...j, offset: [0, 5, 0] as const })) };
    view.show({ ...model, skeleton: longer }, DEFAULT_DISPLAY, undefined);
    expect(view.skinnedMeshes[0]).toBe(mesh);
    expect(mesh.skeleton.bones).toEqual(view.bones);
    expect(view.vertices()[1]).toBe(10);
  });

  it('shows a skin without a skeleton as it is', () => {
    const { skeleton: _, ...bare } = character({ skins: [skin('hero', 3)] });
    const view = shown({ ...bare, pose: [4, 5, 6] });
    expect([...view.vertices()]).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
    expect(view.bounds(new Box3())).toEqual(new Box3(new Vector3(0, 0, 0), new Vector3(1, 1, 0)));
    expect(view.bones).toEqual([]);
  });

  it('uses a skeleton that is added after the skin', () => {
    const model = character({ skins: [skin()] });
    const { skeleton: _, ...bare } = model;
    const view = shown(bare);
    expect(view.vertices()[1]).toBe(0);
    view.show(model, DEFAULT_DISPLAY, undefined);
    expect(view.vertices()[1]).toBe(1);
    view.show(bare, DEFAULT_DISPLAY, undefined);
    expect(view.vertices()[1]).toBe(0);
  });

  it('binds a skin without weights to the root', () => {
    const { attachments: _, ...plain } = skin();
    const view = shown(character({ skins: [plain], pose: [1, 2, 3, 0, 0, 0, 0, 0, 0] }));
    expect([...view.vertices().subarray(0, 3)]).toEqual([1, 3, 3]);
  });

  it('a character without a skin has a box around joints and their boxes', () => {
    const view = shown(character({ skeleton: skeleton(2) }));
    const box = view.bounds(new Box3());
    expectClose([...box.min, ...box.max], [-0.1, 0.9, -0.1, 0.1, 2.1, 0.1], WITHIN.rounding);
  });

  it('draws every placement from the same data', () => {
    const placements = [
      DEFAULT_PLACEMENT,
      { position: [10, 0, 0] as const, turn: [0, Math.PI / 2, 0] as const, scale: 2 },
    ];
    const view = shown(character({ skins: [skin()], placements }));
    const [one, two] = view.skinnedMeshes;
    expect(two.geometry).toBe(one.geometry);
    expect(two.skeleton).toBe(one.skeleton);
    view.object.updateMatrixWorld();
    // Vertex 1 is at (1, 1, 0); the root is raised by 1.
    const at = two.getVertexPosition(1, new Vector3()).applyMatrix4(two.matrixWorld);
    expectClose([...at], [10, 2, -2], WITHIN.rounding);
    expect(view.bounds(new Box3()).max.x).toBeCloseTo(10, 9);
    expect(view.boundsAt(0, new Box3()).max.x).toBeCloseTo(1, 9);
    expect(view.boundsAt(1, new Box3()).min.x).toBeGreaterThan(9);
    expect(view.boundsAt(2, new Box3()).isEmpty()).toBe(true);
    view.show(character({ skins: [skin()], placements: [DEFAULT_PLACEMENT] }), DEFAULT_DISPLAY, undefined);
    expect(view.placements).toHaveLength(1);
  });

  it('cancels horizontal root motion in place, when drawing only', () => {
    const model = character({ skins: [skin()], pose: [3, 4, 5, 0, 0, 0, 0, 0, 0] });
    const view = new CharacterView(new DrawnSkins());
    view.show(model, { ...DEFAULT_DISPLAY, inPlace: true }, undefined);
    expectClose(view.bounds(new Box3()).min.toArray(), [0, 5, 0], WITHIN.rounding);
    expect(view.vertices()[0]).toBe(3);
    view.show(model, DEFAULT_DISPLAY, undefined);
    expectClose(view.bounds(new Box3()).min.toArray(), [3, 5, 5], WITHIN.rounding);
  });

  it('rotates by its own angles, whatever rotations samples gave another character', () => {
    const turning = (channels: readonly BvhChannel[]) => ({ name: 'one', joints: [bvhJoint(-1, channels)] });
    const { skeleton: captured, take } = captureOf(
      turning(['rz', 'rx', 'ry']),
      [
        [0, 0, 0],
        [20, 30, 10],
      ],
      1,
    );
    const capture = shown(character({ skeleton: captured, takes: take ? [take] : [], shownTake: 0 }), 0.5);
    const other = turning(['rx', 'rz', 'ry']);
    const view = shown(character({ skeleton: other, pose: [...capture.dofs] }), 0.5);
    // One after the other, as in playback.
    capture.seek(0.5);
    view.seek(0.5);
    expect(view.dofs).toEqual(capture.dofs);
    expect(view.worldMatrices).not.toEqual(capture.worldMatrices);
    const byAngles = new Float64Array(16);
    worldMatrices(compileSkeleton(other), view.dofs, byAngles);
    expect(view.worldMatrices).toEqual(byAngles);
  });

  it('a character is culled by its current bounds', () => {
    const model = character({ skins: [skin()], takes: [takeOfValues('go', [100])], shownTake: 0 });
    const view = shown(model);
    const { boundingSphere } = view.skinnedMeshes[0];
    expect(boundingSphere.center.x).toBeCloseTo(100.5, 9);
    expect(boundingSphere.radius).toBeLessThan(1);
  });

  it('shows morphs that are added later', () => {
    const model = character({ skins: [skin()], skeleton: skeleton(1) });
    const view = shown(model);
    view.show({ ...model, morphs: [morph('up')], pose: [0, 0, 0, 0, 0, 0, 0.5] }, DEFAULT_DISPLAY, undefined);
    expect([...view.vertices().subarray(0, 3)]).toEqual([0, 1, 2.5]);
    expect(view.bounds(new Box3()).max.z).toBeCloseTo(2.5, 9);
  });

  describe('with a skin too large for one frame', () => {
    const count = 50_000;
    const large = skin('large', 0, {
      positions: new Float64Array(3 * count).fill(1),
      normals: new Float64Array(3 * count),
      attachments: {
        start: Uint32Array.from({ length: count + 1 }, (_, v) => v),
        joints: new Uint32Array(count),
        weights: new Float64Array(count).fill(1),
      },
    });
    const model = character({ skins: [large], pose: [5, 0, 0, 0, 0, 0, 0, 0, 0] });

    it('with a skin too large for one frame has bounds at once, and is shown when prepared', async () => {
      const view = shown(model);
      expect(view.needsPreparing).toBe(true);
      expect(view.skinnedMeshes).toEqual([]);
      expect(view.bounds(new Box3()).max.x).toBeCloseTo(6, 9);
      const progress: number[] = [];
      const one = view.prepare((done) => progress.push(done));
      expect(view.prepare()).toBe(one);
      await one;
      expect(progress.at(-1)).toBe(1);
      expect(view.needsPreparing).toBe(false);
      expect(view.skinnedMeshes[0].visible).toBe(true);
      expect(view.vertices()[3 * count - 3]).toBe(6);
    });

    it('returns its vertices before that on request', async () => {
      const view = shown(model);
      const coming = view.prepare();
      expect(view.vertices()).toHaveLength(3 * count);
      await coming;
      expect(view.needsPreparing).toBe(false);
    });

    it('with a skin too large for one frame is dropped if replaced meanwhile', async () => {
      const view = shown(model);
      const coming = view.prepare();
      view.show({ ...model, skins: [skin()] }, DEFAULT_DISPLAY, undefined);
      await coming;
      expect(view.needsPreparing).toBe(false);
      expect(view.vertices()).toHaveLength(9);
    });

    it('with a skin too large for one frame is dropped when disposed of', async () => {
      const view = shown(model);
      const coming = view.prepare();
      view.dispose();
      await coming;
      expect(view.object.children).toEqual([]);
    });
  });

  it('leaves nothing behind when disposed of', () => {
    const view = shown(character({ skins: [skin()] }));
    view.dispose();
    expect(view.object.children).toEqual([]);
    expect(view.skinnedMeshes).toEqual([]);
    view.seek(1);
  });
});

describe('a heat map of values from outside', () => {
  const heated = (view: CharacterView) => {
    const texture = heatValuesOf(view.skinnedMeshes[0]);
    return { values: texture && [...(texture.image.data ?? [])].slice(0, 3), version: texture?.version ?? 0 };
  };
  const four = { ...DEFAULT_DISPLAY, skin: 'four' } as const;
  const attached = character({ skeleton: skeleton(1), skins: [skin('arm')] });

  it('is that of no joint until there are values, and follows them when it is told', () => {
    const view = new CharacterView(new DrawnSkins());
    view.show(attached, four, undefined);
    expect(heated(view).values).toBeUndefined();
    const values = Float32Array.of(0.5, 1, 0);
    view.heatSkin(values);
    expect(heated(view).values).toEqual([0.5, 1, 0]);
    const { version } = heated(view);
    values[2] = 0.75;
    view.heatSkin(values);
    expect(heated(view).values).toEqual([0.5, 1, 0.75]);
    expect(heated(view).version).toBeGreaterThan(version);
    // Of another skin.
    view.heatSkin(Float32Array.of(1, 1, 1, 1));
    expect(heated(view).values).toEqual([0.5, 1, 0.75]);
  });

  it('a heat map of values from outside and the one of joint weights replace each other', () => {
    const view = new CharacterView(new DrawnSkins());
    view.show(attached, four, 0);
    view.heatSkin(Float32Array.of(0.5, 1, 0));
    view.show(attached, { ...DEFAULT_DISPLAY, skin: 'heat' }, 0);
    expect(heated(view).values).toBeUndefined();
    view.show(attached, four, 0);
    expect(heated(view).values).toEqual([0.5, 1, 0]);
    // What is unchanged is not uploaded again.
    const { version } = heated(view);
    view.show(attached, { ...four, grid: false }, 0);
    expect(heated(view).version).toBe(version);
  });
});
