/** Writes characters as FBX files like those of Mixamo, for tests. */
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { poseAt } from '../../../src/evaluate/pose.ts';
import { multiplyQuaternions, writeAnglesNear, writeQuaternion } from '../../../src/evaluate/rotations/euler-orders.ts';
import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import { invertAffine } from '../../../src/math/mat4.ts';
import { quaternionOfRotation } from '../../../src/math/quaternion.ts';
import { type Character, shownSkin } from '../../../src/model/document.ts';
import type { Skin } from '../../../src/model/skin.ts';
import { type Connection, curve, type Fbx, type Obj, prop, rec, ticks } from './write-fbx.ts';

/** Of each joint and frame: where it is in its parent, and how it is turned. */
function localsOf(source: Character, times: readonly number[]) {
  const skeleton = source.skeleton;
  if (!skeleton) throw new Error('no skeleton');
  const compiled = compileSkeleton(skeleton);
  const worlds = new Float64Array(16 * compiled.jointCount);
  const values = Float64Array.from(source.pose);
  return times.map((time) => {
    poseAt(source, time, values);
    worldMatrices(compiled, values, worlds);
    return skeleton.joints.map(({ parent }, j) => {
      const own = worlds.slice(16 * j, 16 * j + 16);
      const above = parent < 0 ? undefined : worlds.slice(16 * parent, 16 * parent + 16);
      const position = [own[12], own[13], own[14]];
      if (!above) return { position, rotation: rotationOf((c, r) => own[4 * c + r]) };
      const away = position.map((value, k) => value - above[12 + k]);
      const dot = (a: number, v: (k: number) => number) =>
        [0, 1, 2].reduce((sum, k) => sum + above[4 * a + k] * v(k), 0);
      return {
        position: [0, 1, 2].map((a) => dot(a, (k) => away[k])),
        rotation: rotationOf((c, r) => dot(r, (k) => own[4 * c + k])),
      };
    });
  });
}

function rotationOf(at: (column: number, row: number) => number): Float64Array {
  const q = new Float64Array(4);
  quaternionOfRotation(
    Float64Array.from({ length: 9 }, (_, i) => at(Math.floor(i / 3), i % 3)),
    0,
    q,
  );
  return q;
}

/**
 * A character as Mixamo writes it: each joint with a pre-rotation of its own, one take with a key at each of the times,
 * and its skin, without textures.
 * @param scale units of the file per unit of the character
 */
export function mixamoFile(source: Character, times: readonly number[], scale = 1): Fbx {
  const locals = localsOf(source, times);
  const objects: Obj[] = [
    {
      id: 1,
      kind: 'AnimationStack',
      name: 'mixamo.com',
      props: [prop('LocalStart', ticks(times[0])), prop('LocalStop', ticks(times[times.length - 1]))],
    },
    { id: 2, kind: 'AnimationLayer', name: 'BaseLayer' },
  ];
  const connections: Connection[] = [[2, 1]];
  let next = 1000;
  for (const [j, { name, parent }] of (source.skeleton?.joints ?? []).entries()) {
    const before = [(j * 37) % 180, (j * 11) % 60, (j * 53) % 180];
    const inverse = new Float64Array(4);
    writeQuaternion(
      'xyz',
      before.map((degrees) => degrees * RADIANS_PER_DEGREE),
      inverse,
    );
    for (let k = 0; k < 3; k++) inverse[k] = -inverse[k];
    const near = new Float64Array(3);
    // At rest joints are not turned, as in the capture.
    writeAnglesNear('xyz', inverse, near);
    const rest = [...near].map((angle) => angle / RADIANS_PER_DEGREE);
    const angles = locals.map((frame) => {
      const q = new Float64Array(4);
      multiplyQuaternions(inverse, frame[j].rotation, q);
      writeAnglesNear('xyz', q, near);
      return [...near].map((angle) => angle / RADIANS_PER_DEGREE);
    });
    const id = 100 + j;
    objects.push({
      id,
      kind: 'Model',
      name,
      type: 'LimbNode',
      props: [
        prop('Lcl Translation', ...locals[0][j].position.map((value) => scale * value)),
        prop('Lcl Rotation', ...rest),
        prop('PreRotation', ...before),
      ],
    });
    connections.push([id, parent < 0 ? 0 : 100 + parent]);
    const drive = (property: string, values: readonly (readonly number[])[]) => {
      const node = next++;
      objects.push({ id: node, kind: 'AnimationCurveNode', name: property });
      connections.push([node, 2], [node, id, property]);
      for (const [k, axis] of ['X', 'Y', 'Z'].entries()) {
        const own = next++;
        objects.push(
          curve(
            own,
            times.map((time, f) => ({ time, value: values[f][k], flags: 4 })),
          ),
        );
        connections.push([own, node, `d|${axis}`]);
      }
    };
    drive('Lcl Rotation', angles);
    if (parent < 0)
      drive(
        'Lcl Translation',
        locals.map((frame) => frame[j].position.map((value) => scale * value)),
      );
  }
  const skin = shownSkin(source);
  if (skin) addSkin(skin, scale, objects, connections);
  return { objects, connections };
}

const MESH = 10_000_000;

/** A mesh, and a cluster for each joint that moves some of it. */
function addSkin(skin: Skin, scale: number, objects: Obj[], connections: Connection[]): void {
  const corners = Int32Array.from(skin.triangles, (v, i) => (i % 3 === 2 ? -v - 1 : v));
  const [model, geometry, deformer] = [MESH, MESH + 1, MESH + 2];
  objects.push(
    { id: model, kind: 'Model', name: 'body', type: 'Mesh' },
    {
      id: geometry,
      kind: 'Geometry',
      name: 'body',
      type: 'Mesh',
      children: [rec('Vertices', [skin.positions.map((value) => scale * value)]), rec('PolygonVertexIndex', [corners])],
    },
    { id: deformer, kind: 'Deformer', name: '', type: 'Skin' },
  );
  connections.push([model, 0], [geometry, model], [deformer, geometry]);
  const { start, joints, weights } = skin.attachments ?? { start: [], joints: [], weights: [] };
  for (let j = 0; j < skin.bindings.length / 16; j++) {
    const moved: number[] = [];
    const by: number[] = [];
    for (let v = 0; v + 1 < start.length; v++) {
      for (let a = start[v]; a < start[v + 1]; a++) {
        if (joints[a] !== j || weights[a] === 0) continue;
        moved.push(v);
        by.push(weights[a]);
      }
    }
    if (moved.length === 0) continue;
    const id = MESH + 100 + j;
    const binding = skin.bindings
      .slice(16 * j, 16 * j + 16)
      .map((value, i) => (i > 11 && i < 15 ? scale * value : value));
    objects.push({
      id,
      kind: 'Deformer',
      name: '',
      type: 'Cluster',
      children: [
        rec('Indexes', [Int32Array.from(moved)]),
        rec('Weights', [Float64Array.from(by)]),
        // The mesh is where its vertices are said to be.
        rec('Transform', [inverseOf(binding)]),
        rec('TransformLink', [binding]),
      ],
    });
    connections.push([id, deformer], [100 + j, id]);
  }
}

function inverseOf(matrix: Float64Array): Float64Array {
  const inverse = new Float64Array(16);
  invertAffine(matrix, 0, inverse, 0);
  return inverse;
}
