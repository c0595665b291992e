import { InstancedMesh, Matrix4, ShaderMaterial, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { DEFAULT_DISPLAY, type Display } from '../../../src/model/session.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { NO_BOX, type Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { Bones } from '../../../src/view/skeleton/bones.ts';
import type { PosedSkeleton } from '../../../src/view/skeleton/drawn-skeletons.ts';
import { SkeletonDrawing } from '../../../src/view/skeleton/skeleton-drawing.ts';
import { STAGE_THEMES } from '../../../src/view/theme.ts';
import { joint, skeleton } from '../../helpers/builders.ts';
import { personSkeleton } from '../../helpers/mocap.ts';

function posed(characterId: string, of: Skeleton): PosedSkeleton {
  const world = new Float64Array(16 * of.joints.length);
  const dofs = Float64Array.from(filePose(of, 0));
  worldMatrices(compileSkeleton(of), dofs, world);
  return {
    characterId,
    skeleton: of,
    world,
    dofs,
    placements: Float64Array.from(new Matrix4().elements),
    hasSkin: false,
  };
}

function drawn(skeletons: readonly Skeleton[], display: Partial<Display> = {}): SkeletonDrawing {
  const drawing = new SkeletonDrawing();
  const all = skeletons.map((s, i) => posed(`c${i}`, s));
  drawing.show(all, { ...DEFAULT_DISPLAY, ...display }, {}, STAGE_THEMES.dark);
  drawing.fill();
  return drawing;
}

/** The draw calls of a frame: meshes that aren't empty. */
function calls({ object }: SkeletonDrawing): InstancedMesh[] {
  return object.children.filter(
    (mesh): mesh is InstancedMesh => mesh instanceof InstancedMesh && mesh.visible && mesh.count > 0,
  );
}

/** Triangles per instance of each mesh drawn. */
function triangles(drawing: SkeletonDrawing): number[] {
  return calls(drawing)
    .map(({ geometry }) => (geometry.index?.count ?? 0) / 3)
    .sort((a, b) => b - a);
}

/** Instances of a mesh with a size other than 0. */
function seen(mesh: InstancedMesh): number[] {
  const matrix = new Matrix4();
  return Array.from({ length: mesh.count }, (_, i) => i).filter((i) => {
    mesh.getMatrixAt(i, matrix);
    return matrix.determinant() !== 0;
  });
}

describe('a skeleton without boxes', () => {
  it('a skeleton without boxes is drawn as balls and bones, End Sites included', () => {
    const [balls, bones] = calls(drawn([personSkeleton()]));
    expect(seen(balls)).toHaveLength(9);
    // One for each joint but the root, one for each End Site.
    expect(seen(bones)).toEqual([1, 2, 3, 4, 5, 6, 7, 8]);
  });

  it('joints of a file without boxes are drawn as those of a capture, as is a box without size', () => {
    const bare: Skeleton = { name: 'bare', joints: [-1, 0, 1].map((parent) => joint(parent, { box: NO_BOX })) };
    const [balls, bones, ...others] = calls(drawn([bare]));
    expect(others).toEqual([]);
    expect(seen(balls)).toEqual([0, 1, 2]);
    expect(seen(bones)).toEqual([1, 2]);
  });

  it('costs two draw calls for fifty characters of seventy joints', () => {
    const [first, ...others] = personSkeleton().joints;
    const seventy: Skeleton = {
      name: 'seventy',
      joints: [first, ...others, ...Array.from({ length: 64 }, (_, i) => ({ ...others[0], parent: 5 + i }))],
    };
    const fifty = Array.from({ length: 50 }, () => seventy);
    const drawing = drawn(fifty);
    expect(calls(drawing)).toHaveLength(2);
    expect(drawing.instanceCount).toBe(50 * (70 + 64 + 3));
  });

  it('a skeleton without boxes is drawn with a third of the triangles among many, under a skin too, and as before once they are gone', () => {
    const drawing = drawn([personSkeleton()]);
    const alone = triangles(drawing);
    const show = (count: number, display: Partial<Display>) => {
      const all = Array.from({ length: count }, (_, i) => ({ ...posed(`c${i}`, personSkeleton()), hasSkin: true }));
      drawing.show(all, { ...DEFAULT_DISPLAY, bones: true, ...display }, {}, STAGE_THEMES.dark);
    };
    show(60, { skin: 'hidden' });
    const many = triangles(drawing);
    expect(many).toHaveLength(2);
    many.forEach((count, i) => {
      expect(count).toBeLessThan(0.7 * alone[i]);
    });
    expect(many[0] + many[1]).toBeLessThan(0.4 * (alone[0] + alone[1]));
    show(60, { skin: 'solid' });
    expect(triangles(drawing)).toEqual([many[0], many[0], many[1], many[1]]);
    show(1, { skin: 'solid' });
    expect(triangles(drawing)).toEqual([alone[0], alone[0], alone[1], alone[1]]);
  });

  it('twenty thousand joints are drawn with fewer than half a million triangles, and few again as before', () => {
    const drawing = drawn([personSkeleton()]);
    const alone = triangles(drawing);
    const star = { name: 'star', joints: Array.from({ length: 20_000 }, (_, j) => joint(j ? 0 : -1)) };
    drawing.show([posed('star', star)], { ...DEFAULT_DISPLAY, boxes: 'hidden', bones: true }, {}, STAGE_THEMES.dark);
    const [ball, bone] = triangles(drawing);
    expect(drawing.instanceCount).toBe(20_000);
    expect(20_000 * (ball + bone)).toBeLessThan(500_000);
    drawing.show([posed('c0', personSkeleton())], DEFAULT_DISPLAY, {}, STAGE_THEMES.dark);
    expect(triangles(drawing)).toEqual(alone);
  });

  it('leaves boxes to those that have them, side by side', () => {
    const box = { min: [0, 0, 0], max: [1, 1, 1] } as const;
    const boxed = { name: 'boxed', joints: skeleton(3).joints.map((j) => ({ ...j, box })) };
    const drawing = drawn([personSkeleton(), boxed]);
    const [edges, faces, balls, bones] = calls(drawing);
    expect(seen(edges)).toEqual([9, 10, 11]);
    expect(seen(faces)).toEqual([9, 10, 11]);
    expect(seen(balls)).toHaveLength(9);
    expect(seen(bones).every((i) => i < 9)).toBe(true);
  });

  it('a skeleton without boxes is not drawn where boxes are hidden, but for the bones that were asked for', () => {
    expect(calls(drawn([personSkeleton()], { boxes: 'hidden' }))).toHaveLength(0);
    expect(calls(drawn([personSkeleton()], { boxes: 'hidden', bones: true }))).toHaveLength(2);
  });
});

describe('the bone to an End Site', () => {
  it('leads from its joint to it', () => {
    const root = personSkeleton().joints[0];
    const one: Skeleton = { name: 'one', joints: [{ ...root, endSites: [[0, 20, 0]] }] };
    const [, bones] = calls(drawn([one]));
    const matrix = new Matrix4();
    bones.getMatrixAt(1, matrix);
    expect(new Vector3(0, 0, 0).applyMatrix4(matrix).toArray()).toEqual([0, 0, 0]);
    expect(new Vector3(0, 1, 0).applyMatrix4(matrix).toArray()).toEqual([0, 20, 0]);
  });

  it('takes the joint’s turn with it', () => {
    const motion = { kind: 'bvh', channels: ['rz'], positions: 'replace' } as const;
    const turned = joint(-1, { motion, pose: [Math.PI / 2], offset: [0, 0, 0], endSites: [[0, 2, 0]] });
    const { positions } = drawn([{ name: 'turned', joints: [turned] }]);
    expect(positions[3]).toBeCloseTo(-2, 12);
    expect(positions[4]).toBeCloseTo(0, 12);
  });
});

describe('a joint with a bone of its own', () => {
  const hinge = { kind: 'hinge', axis: [0, 0, 1] } as const;
  const upper = joint(-1, { motion: hinge, pose: [Math.PI / 2], offset: [0, 0, 0], length: 2 });
  const lower = joint(0, { motion: hinge, pose: [0], offset: [0, 2, 0], length: 1 });
  const arm: Skeleton = { name: 'arm', joints: [upper, lower] };

  it('a joint with a bone of its own is drawn as bones to its tip, and picked there', () => {
    const drawing = drawn([arm]);
    const [balls, bones] = calls(drawing);
    expect([seen(balls), seen(bones)]).toEqual([
      [0, 1, 2],
      [1, 2],
    ]);
    expect([...drawing.positions.subarray(6, 9)].map((v) => Math.round(v * 1e9) / 1e9)).toEqual([-3, 0, 0]);
    expect(drawing.jointAt(2)).toEqual({ characterId: 'c0', placement: 0, joint: 1 });
    expect(drawing.boneOwner(2)).toEqual({ characterId: 'c0', placement: 0, joint: 1 });
  });

  it('a joint with a bone of its own has its box drawn where one is set', () => {
    const boxed = { ...lower, box: { min: [0, 0, 0], max: [0.5, 1, 0.5] } as const };
    const [edges, faces, balls] = calls(drawn([{ name: 'arm', joints: [upper, boxed] }]));
    expect([seen(edges), seen(faces)]).toEqual([[1], [1]]);
    expect(seen(balls)).toEqual([0, 1, 2]);
  });
});

describe('a skeleton whose boxes nobody made', () => {
  const cubes: Skeleton = { name: 'cubes', joints: [joint(-1), joint(0), joint(1)] };
  const box = { min: [0, 0, 0], max: [1, 1, 1] } as const;
  const kindsOf = (of: Skeleton, more: Partial<PosedSkeleton> = {}, display: Partial<Display> = {}) => {
    const drawing = new SkeletonDrawing();
    drawing.show([{ ...posed('c1', of), ...more }], { ...DEFAULT_DISPLAY, ...display }, {}, STAGE_THEMES.dark);
    drawing.fill();
    return calls(drawing).length;
  };
  const boxed: Skeleton = { ...cubes, joints: cubes.joints.map((j, i) => (i > 0 ? { ...j, box } : j)) };

  it('a skeleton is drawn as bones too while most of its boxes are the default ones', () => {
    const asBoxes = kindsOf(boxed);
    expect(kindsOf(cubes)).toBe(asBoxes + 2);
    expect(kindsOf({ ...cubes, joints: cubes.joints.map((j, i) => (i > 1 ? { ...j, box } : j)) })).toBe(asBoxes + 2);
  });

  it('a skeleton is drawn as bones instead where its boxes would hide it, unless they are asked for', () => {
    const huge = { min: [-5, -5, -5], max: [5, 5, 5] } as const;
    const exported: Skeleton = {
      name: 'exported',
      joints: Array.from({ length: 20 }, (_, i) => joint(i - 1, { box: huge })),
    };
    const bones = kindsOf(exported, {}, { boxes: 'hidden', bones: true });
    expect(kindsOf(exported)).toBe(bones);
    expect(kindsOf(exported, {}, { boxes: 'wire' })).toBeLessThan(bones);
    // Framed by the bones, not by the boxes.
    const reach = new Float64Array(6);
    const posedBones = new Bones(exported);
    posedBones.pose(Float64Array.from(filePose(exported, 0)));
    posedBones.bounds(reach);
    expect(reach[3] - reach[0]).toBe(0);
  });

  it('a skeleton has a dot at each selected joint, at every instance, and none at joints that don’t exist', () => {
    const drawing = new SkeletonDrawing();
    const twice = Float64Array.from([...new Matrix4().elements, ...new Matrix4().makeTranslation(3, 0, 0).elements]);
    const dots = (others: readonly number[]) => {
      const selection = { characterId: 'c1', joint: 0, others };
      drawing.show([{ ...posed('c1', cubes), placements: twice }], DEFAULT_DISPLAY, selection, STAGE_THEMES.dark);
      drawing.fill();
      const all = calls(drawing).filter(
        ({ material }) => material instanceof ShaderMaterial && material.uniforms.hollow,
      );
      return all.map(({ count }) => count);
    };
    expect(dots([])).toEqual([2]);
    expect(dots([1, 2])).toEqual([4, 2]);
    expect(dots([1, 99])).toEqual([2, 2]);
  });

  it('a skeleton with default boxes gets no bones under a skin, or where boxes are hidden', () => {
    expect(kindsOf(cubes, { hasSkin: true }, { boxes: 'wire' })).toBe(
      kindsOf(boxed, { hasSkin: true }, { boxes: 'wire' }),
    );
    expect(kindsOf(cubes, {}, { boxes: 'hidden' })).toBe(0);
  });
});
