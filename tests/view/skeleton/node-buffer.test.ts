import { BufferGeometry, Matrix4, MeshBasicMaterial, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { nodesFor, sizesFor } from '../../../src/view/skeleton/drawn-skeletons.ts';
import { NODE_STRIDE, NodeBuffer, NodeMesh, type NodeShape } from '../../../src/view/skeleton/node-buffer.ts';
import { fillBones, fillNodes, placePoints, placePositions } from '../../../src/view/skeleton/node-matrices.ts';
import { personSkeleton } from '../../helpers/mocap.ts';

/** Floats against doubles, for a character some 100 units high. */
const SAME_ELEMENT = 1e-4;

const skeleton = personSkeleton();
const nodes = nodesFor(skeleton);
const sizes = sizesFor(skeleton);
const world = new Float64Array(16 * nodes.jointCount);
for (let j = 0; j < nodes.jointCount; j++) {
  new Matrix4()
    .makeRotationZ(0.4 * j)
    .setPosition(10 * j, 7 - j * j, 3 * j)
    .toArray(world, 16 * j);
}
const placement = Float64Array.from(new Matrix4().makeRotationY(0.7).scale(new Vector3(2, 2, 2)).elements);

function meshOf(shape: NodeShape, buffer: NodeBuffer, count: number): NodeMesh {
  const geometry = new BufferGeometry();
  buffer.resize(count, [geometry]);
  return new NodeMesh(geometry, new MeshBasicMaterial(), count, shape);
}

describe('balls and bones out of a buffer of nodes', () => {
  it('stand where matrices of their own would put them', () => {
    const first = 4;
    const count = first + nodes.count;
    const positions = new Float64Array(3 * count);
    placePositions(nodes, placement, 0, world, positions, first);
    const buffer = new NodeBuffer();
    const balls = meshOf('ball', buffer, count);
    const bones = meshOf('bone', buffer, count);
    fillNodes(nodes, sizes, 2, positions, buffer.values, first);

    const placed = new Float64Array(16 * nodes.count);
    placePoints(nodes, placement, 0, world, placed);
    const ofBalls = new Float32Array(16 * count);
    const ofBones = new Float32Array(16 * count);
    const parents = Int32Array.from(skeleton.joints, (j) => j.parent);
    fillBones(nodes, parents, sizes, 2, placed, ofBalls, ofBones, first);
    const matrix = new Matrix4();
    for (let n = first; n < count; n++) {
      for (const [mesh, all] of [
        [balls, ofBalls],
        [bones, ofBones],
      ] as const) {
        mesh.getMatrixAt(n, matrix);
        matrix.elements.forEach((value, i) => {
          expect(Math.abs(value - all[16 * n + i])).toBeLessThan(SAME_ELEMENT);
        });
      }
    }
  });

  it('balls and bones are drawn from the new buffer when the old one was too small', () => {
    const buffer = new NodeBuffer();
    const balls = meshOf('ball', buffer, 2);
    buffer.resize(5, [balls.geometry]);
    buffer.values.set([1, 2, 3, 0.5], 4 * NODE_STRIDE);
    const matrix = new Matrix4();
    balls.getMatrixAt(4, matrix);
    expect(matrix.elements).toEqual([0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 1, 2, 3, 1]);
  });
});
