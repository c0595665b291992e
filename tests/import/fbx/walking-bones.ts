/** Two joints that turn, the upper one with a pre-rotation, and a square skinned to both. */
import { curve, type Fbx, prop, rec, ticks } from './write-fbx.ts';

const IDENTITY = Float64Array.from({ length: 16 }, (_, i) => (i % 5 === 0 ? 1 : 0));
const CUBIC_USER = 8 | 0x400;

export const walkingBones: Fbx = {
  objects: [
    { id: 1, kind: 'AnimationStack', name: 'Walk', props: [prop('LocalStart', ticks(0)), prop('LocalStop', ticks(1))] },
    { id: 2, kind: 'AnimationLayer', name: 'Base' },
    { id: 10, kind: 'Model', name: 'hip', type: 'LimbNode', props: [prop('PreRotation', 20, 30, 40)] },
    { id: 11, kind: 'Model', name: 'knee', type: 'LimbNode', props: [prop('Lcl Translation', 0, 1, 0)] },
    { id: 12, kind: 'Model', name: 'body', type: 'Mesh' },
    {
      id: 13,
      kind: 'Geometry',
      name: 'body',
      type: 'Mesh',
      children: [
        rec('Vertices', [Float64Array.of(0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 0)]),
        rec('PolygonVertexIndex', [Int32Array.of(0, 1, 2, -4)]),
      ],
    },
    { id: 14, kind: 'Deformer', name: '', type: 'Skin' },
    ...[15, 16].map((id) => ({
      id,
      kind: 'Deformer',
      name: '',
      type: 'Cluster',
      children: [
        rec('Indexes', [Int32Array.of(0, 1, 2, 3)]),
        rec('Weights', [id === 15 ? Float64Array.of(1, 1, 0.25, 0.5) : Float64Array.of(0, 0, 0.75, 0.5)]),
        rec('Transform', [IDENTITY]),
        rec('TransformLink', [IDENTITY]),
      ],
    })),
    ...[20, 21].map((id) => ({
      id,
      kind: 'AnimationCurveNode',
      name: 'R',
      props: [prop('d|X', 0), prop('d|Y', 0), prop('d|Z', 0)],
    })),
    ...[30, 31].map((id) =>
      curve(id, [
        { time: 0, value: 0, flags: CUBIC_USER, data: [90, 0, 0, 0] },
        { time: 0.5, value: 40, flags: CUBIC_USER, data: [0, -60, 0, 0] },
        { time: 1, value: -20, flags: 4 },
      ]),
    ),
  ],
  connections: [
    [2, 1],
    [10, 0],
    [11, 10],
    [12, 0],
    [13, 12],
    [14, 13],
    [15, 14],
    [16, 14],
    [10, 15],
    [11, 16],
    [20, 2],
    [21, 2],
    [20, 10, 'Lcl Rotation'],
    [21, 11, 'Lcl Rotation'],
    [30, 20, 'd|X'],
    [31, 21, 'd|Z'],
  ],
};
