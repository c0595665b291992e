import { expect, it } from 'vitest';
import type { Scene } from '../../src/import/scene.ts';
import { toCharacter } from '../../src/import/to-character.ts';
import { expectLinearTime } from '../helpers/growth.ts';

/** Every node has a triangle of its own. */
function crowd(count: number): Scene {
  return {
    name: 'crowd',
    metres: 1,
    nodes: Array.from({ length: count }, (_, i) => ({
      name: `n${i}`,
      parent: -1,
      translation: [i, 0, 0],
      rotation: [0, 0, 0, 1],
      scale: [1, 1, 1],
    })),
    meshes: Array.from({ length: count }, (_, i) => ({
      name: '',
      node: i,
      positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0),
      surfaces: [{ material: -1, triangles: Uint32Array.of(0, 1, 2) }],
      targets: [],
    })),
    materials: [],
    textures: [],
    takes: [],
  };
}

it('a scene of many meshes becomes a character in a time that grows with their number', () => {
  expectLinearTime((n) => {
    const made = toCharacter(crowd(n));
    expect(made?.skins[0].positions.length).toBe(9 * n);
    expect(made?.skins[0].positions[9 * n - 9]).toBe(n - 1);
  }, 4000);
});
