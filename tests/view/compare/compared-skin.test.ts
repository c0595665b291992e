import { type Group, type InstancedMesh, Matrix4, Mesh, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { ComparedSkin, type ComparedVertices } from '../../../src/view/compare/compared-skin.ts';
import { STAGE_THEMES } from '../../../src/view/theme.ts';
import { skin } from '../../helpers/builders.ts';

const model = skin('hero', 0, {
  positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0),
  normals: Float64Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1),
  triangles: Uint32Array.of(0, 1, 2, 2, 1, 3),
});
const theirs = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 3);
const placement = new Matrix4().makeScale(2, 2, 2).setPosition(1, 0, 0);
const placements = Float64Array.from([...new Matrix4().elements, ...placement.elements]);

function compared(change: Partial<ComparedVertices> = {}): ComparedVertices {
  return { skin: model, ours: model.positions, theirs, errors: Float32Array.of(0, 0, 0, 1), worst: 3, ...change };
}

function partsOf(drawing: ComparedSkin) {
  // Made in this order: depths, meshes, the circle.
  const [depths, meshes, mark] = drawing.object.children as [Group, Group, InstancedMesh];
  return { depths, meshes, mark };
}

describe('a compared skin', () => {
  it('their vertices are drawn with our triangles, at every placement', () => {
    const drawing = new ComparedSkin();
    drawing.show(compared(), 'both', 2);
    drawing.fill(placements);
    const { meshes } = partsOf(drawing);
    expect(meshes.children).toHaveLength(2);
    const [, second] = meshes.children;
    if (!(second instanceof Mesh)) throw new Error('Not a mesh.');
    expect([...second.geometry.getAttribute('position').array]).toEqual([...theirs]);
    expect([...second.geometry.getIndex().array]).toEqual([...model.triangles]);
    expect(second.matrix.elements).toEqual(placement.elements);
  });

  it('beside ours theirs is a ghost, alone it has the colours of the errors', () => {
    const drawing = new ComparedSkin();
    const { meshes, depths } = partsOf(drawing);
    drawing.show(compared(), 'both', 1);
    const materialOf = () => (meshes.children[0] instanceof Mesh ? meshes.children[0].material.name : undefined);
    expect([materialOf(), depths.visible]).toEqual(['skin xray', true]);
    drawing.show(compared(), 'theirs', 1);
    expect([materialOf(), depths.visible, meshes.visible]).toEqual(['skin heat', false, true]);
    drawing.show(compared(), 'ours', 1);
    expect([depths.visible, meshes.visible]).toEqual([false, false]);
    drawing.show(compared({ theirs: undefined }), 'both', 1);
    expect([depths.visible, meshes.visible]).toEqual([false, false]);
  });

  it('the worst vertex is marked on the skin that is drawn, ours before theirs', () => {
    const drawing = new ComparedSkin();
    const { mark } = partsOf(drawing);
    const marked = (instance: number) => {
      const matrix = new Matrix4();
      mark.getMatrixAt(instance, matrix);
      return new Vector3().setFromMatrixPosition(matrix).toArray();
    };
    drawing.show(compared(), 'both', 2);
    drawing.fill(placements);
    expect([marked(0), marked(1)]).toEqual([
      [1, 1, 0],
      [3, 2, 0],
    ]);
    drawing.show(compared(), 'theirs', 2);
    drawing.fill(placements);
    expect(marked(0)).toEqual([1, 1, 3]);
    drawing.show(compared({ worst: undefined }), 'both', 2);
    expect(mark.visible).toBe(false);
  });

  it('numbers of another time replace those before in the same buffers', () => {
    const drawing = new ComparedSkin();
    const { meshes } = partsOf(drawing);
    const geometry = () => (meshes.children[0] instanceof Mesh ? meshes.children[0].geometry : undefined);
    drawing.show(compared(), 'both', 1);
    const before = geometry();
    drawing.show(compared({ theirs: model.positions }), 'both', 1);
    expect(geometry()).toBe(before);
    expect([...(before?.getAttribute('position').array ?? [])]).toEqual([...model.positions]);
  });

  it('frees all it has', () => {
    const drawing = new ComparedSkin();
    drawing.setTheme(STAGE_THEMES.light);
    drawing.show(compared(), 'both', 1);
    const all = new Set<unknown>();
    const freed = new Set<unknown>();
    drawing.object.traverse((mesh) => {
      if (!(mesh instanceof Mesh)) return;
      for (const part of [mesh.geometry, mesh.material].flat()) {
        all.add(part);
        part.addEventListener('dispose', () => freed.add(part));
      }
    });
    drawing.dispose();
    // Geometry and materials of the ghost and its depth; those of the circle.
    expect(all.size).toBe(5);
    expect(freed).toEqual(all);
  });
});
