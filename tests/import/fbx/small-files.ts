/** Small FBX files, what is read of them, and why they are refused. */
import { expect } from 'vitest';
import { readFbx } from '../../../src/import/fbx/read.ts';
import type { Scene } from '../../../src/import/scene.ts';
import { type Connection, curve, type Fbx, fbxBytes, type Obj, prop, type Rec, rec, ticks } from './write-fbx.ts';

/** A file as it is read, with what is told of it. */
export function read(bytes: Uint8Array | string) {
  return readFbx('file.fbx', typeof bytes === 'string' ? new TextEncoder().encode(bytes) : new Uint8Array(bytes));
}

/** @throws Error with what is told, if it is refused */
export function sceneOf(fbx: Fbx): Scene {
  const { value, diagnostics } = read(fbxBytes(fbx));
  if (!value) throw new Error(diagnostics.map(({ message }) => message).join('\n'));
  return value;
}

/** Why a file is refused: one error a line. */
export function errorOf(bytes: Uint8Array | string): string {
  const { value, diagnostics } = read(bytes);
  expect(value).toBeUndefined();
  return diagnostics
    .filter(({ severity }) => severity === 'error')
    .map(({ message }) => message)
    .join('\n');
}

/** Degrees as radians. */
export const inRadians = (degrees: readonly number[]) => degrees.map((angle) => (angle * Math.PI) / 180);

/** A joint. */
export const bone = (id: number, name: string, ...props: Obj['props'] & object): Obj => ({
  id,
  kind: 'Model',
  name,
  type: 'LimbNode',
  props,
});

/** Properties that all objects of a kind have that don't state them: for `before`. */
export const template = (kind: string, className: string, ...props: Obj['props'] & object) =>
  rec(
    'Definitions',
    [],
    [
      rec(
        'ObjectType',
        [kind],
        [
          rec('PropertyTemplate', ['FbxOther'], [rec('Properties70')]),
          rec('PropertyTemplate', [className], [rec('Properties70', [], props)]),
        ],
      ),
    ],
  );

/** A model with one mesh: a square in the plane of x and y, unless it says otherwise. */
export function meshFile(
  layers: readonly ReturnType<typeof rec>[],
  options: {
    points?: number[];
    corners?: number[];
    props?: Obj['props'];
    objects?: Obj[];
    connections?: Connection[];
    version?: number;
    before?: readonly Rec[];
  } = {},
): Fbx {
  const {
    points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0],
    corners = [0, 1, 2, -4],
    props = [],
    objects = [],
    connections = [],
    version = 7400,
    before = [],
  } = options;
  return {
    version,
    before,
    objects: [
      { id: 10, kind: 'Model', name: 'square', type: 'Mesh', props },
      {
        id: 11,
        kind: 'Geometry',
        name: 'square',
        type: 'Mesh',
        children: [
          rec('Vertices', [Float64Array.from(points)]),
          rec('PolygonVertexIndex', [Int32Array.from(corners)]),
          ...layers,
        ],
      },
      ...objects,
    ],
    connections: [[10, 0], [11, 10], ...connections],
  };
}

/** An element of a mesh, such as its normals. */
export const layer = (name: string, mapping: string, reference: string, ...arrays: ReturnType<typeof rec>[]) =>
  rec(
    name,
    [{ int: 0 }],
    [rec('MappingInformationType', [mapping]), rec('ReferenceInformationType', [reference]), ...arrays],
  );

/** Flags of a key: cubic, with tangents of its own. */
export const CUBIC_USER = 8 | 0x400;

/** One bone whose rotation has a curve about z. */
export function turning(keys: Parameters<typeof curve>[1], ...props: Obj['props'] & object): Fbx {
  return {
    objects: [
      bone(10, 'hip', ...props),
      {
        id: 1,
        kind: 'AnimationStack',
        name: 'Walk',
        props: [prop('LocalStart', ticks(0)), prop('LocalStop', ticks(2))],
      },
      { id: 2, kind: 'AnimationLayer', name: 'Base' },
      { id: 3, kind: 'AnimationCurveNode', name: 'R', props: [prop('d|X', 0), prop('d|Y', 0), prop('d|Z', 0)] },
      curve(4, keys),
    ],
    connections: [
      [10, 0],
      [2, 1],
      [3, 2],
      [3, 10, 'Lcl Rotation'],
      [4, 3, 'd|Z'],
    ],
  };
}

/** The keys of what `turning` turns. @throws Error if there are none */
export function zCurve({ takes }: Scene) {
  const rotation = takes[0].moves[0].rotation;
  const channel = rotation?.kind === 'euler' ? rotation.angles[2] : undefined;
  if (channel?.kind !== 'keys') throw new Error('no keys');
  return channel;
}
