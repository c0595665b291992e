/** A limb as a skin, for what happens inside of it. */
import { oneSurface, type Skin } from '../../src/model/skin.ts';
import { tube } from '../evaluate/weights/meshes.ts';
import { skin } from './builders.ts';

/** A closed tube of radius 1 up from y 0 to 10, bound to joint 0. */
export function limbSkin(at: readonly [x: number, z: number] = [0, 0]): Skin {
  const { positions, triangles } = tube({ around: 48, along: 10, radius: 1, length: 10, at });
  const count = positions.length / 3;
  return skin('limb', 0, {
    positions,
    normals: new Float64Array(positions.length),
    triangles,
    surfaces: oneSurface(triangles),
    attachments: {
      start: Uint32Array.from({ length: count + 1 }, (_, v) => v),
      joints: new Uint32Array(count),
      weights: new Float64Array(count).fill(1),
    },
  });
}
