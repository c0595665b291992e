/** Frame rates that files of other programs state, or that their keys have. */
import { describe, expect, it } from 'vitest';
import { importFile } from '../../src/files/imports.ts';
import { toCharacter } from '../../src/import/to-character.ts';
import { sceneOf, turning } from './fbx/small-files.ts';
import { prop } from './fbx/write-fbx.ts';
import { GltfMaker, glbOf } from './make-gltf.ts';

/** Keys at every second of 30 frames a second. */
const keys = Array.from({ length: 30 }, (_, k) => ({ time: k / 15, value: k * k, flags: 4 }));
const mode = (value: number) => prop('TimeMode', { int: value });

function rateIn(settings: ReturnType<typeof prop>[], at = keys): number | undefined {
  const character = toCharacter(sceneOf({ ...turning(at), settings }));
  return character?.takes[0].framesPerSecond;
}

describe('the frame rate of an FBX file', () => {
  it.each([
    [1, 120],
    [2, 100],
    [3, 60],
    [4, 50],
    [5, 48],
    [6, 30],
    [7, 30],
    [8, 30 / 1.001],
    [9, 30 / 1.001],
    [10, 25],
    [11, 24],
    [12, 1000],
    [13, 24 / 1.001],
    [15, 96],
    [16, 72],
    [17, 60 / 1.001],
    [18, 120 / 1.001],
  ])('of TimeMode %i is %d, whatever its keys', (value, rate) => {
    expect(rateIn([mode(value)])).toBeCloseTo(rate, 9);
  });

  it.each([
    [12.5, 12.5],
    [23.976, 24 / 1.001],
    [59.9988, 60],
  ])('of a custom rate of %d is %d', (custom, rate) => {
    expect(rateIn([mode(14), prop('CustomFrameRate', custom)])).toBeCloseTo(rate, 9);
  });

  it('is that of its keys where it states none', () => {
    const everyFrame = keys.map((key, k) => ({ ...key, time: k / 24 }));
    for (const settings of [[], [mode(0)], [mode(14)], [mode(14), prop('CustomFrameRate', -1)], [mode(99)]]) {
      expect(rateIn(settings, everyFrame)).toBeCloseTo(24, 9);
    }
    expect(rateIn([], keys.slice(0, 2))).toBeUndefined();
  });
});

it('the frame rate of a glTF file is that of its keys, of all channels together', async () => {
  const maker = new GltfMaker();
  const turned = (frames: readonly number[]) => ({
    input: maker.add(
      'SCALAR',
      Float32Array.from(frames, (frame) => frame / 24),
    ),
    output: maker.add('VEC4', Float32Array.from(frames.flatMap((f) => [0, 0, Math.sin(f), Math.cos(f)]))),
    interpolation: 'LINEAR',
  });
  const channel = (node: number) => ({ sampler: node, target: { node, path: 'rotation' } });
  const POSITION = maker.add('VEC3', Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0));
  const made = maker.made({
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ children: [1] }, { mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION } }] }],
    animations: [{ samplers: [turned([1, 5, 11, 25]), turned([1, 10, 25])], channels: [channel(0), channel(1)] }],
  });
  const given = { fileName: 'x.glb', bytes: glbOf(made), beside: async () => undefined };
  const { value } = await importFile('gltf', given);
  // Rotations are fitted by keys in between, which are on no frame.
  expect(value?.characters[0].takes[0].framesPerSecond).toBe(24);
});
