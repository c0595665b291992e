/** Files that walks begin with: real ones of every kind, if they are here. */
import { basename } from 'node:path';
import type { DroppedFile } from '../../../helpers/page.ts';
import { hasShared, sharedBytes } from '../../../helpers/shared.ts';

/** Below data/ of the reference files. */
const REAL: readonly (readonly string[])[] = [
  ['cse169/wasp.skel', 'cse169/wasp.skin', 'cse169/wasp_walk.anim'],
  [],
  ['bvh/poser-sl-walk.bvh'],
  ['axis-skel/human.axskel'],
  ['cse169/head.skel', 'cse169/head_tex.skin', 'cse169/head.bmp', 'cse169/head1.morph', 'cse169/head2.morph'],
  ['gltf/Fox.glb'],
  ['synthetic/nine.skel', 'synthetic/nine.skin', 'bvh/mixamo-names.bvh'],
  ['cse169/wasp.rig', 'cse169/wasp.skel', 'cse169/wasp.skin'],
  ['fbx/maya_game_sausage_7500_binary_combined.fbx'],
  ['bvh/openni-kinect-hash-names.bvh', 'cse169/wasp.skel'],
  ['gltf/greenman.glb'],
];

const OWN: readonly DroppedFile[] = [
  {
    name: 'arm.skel',
    bytes: `balljoint shoulder { boxmin -0.1 0 -0.1 boxmax 0.1 1 0.1
      hingejoint elbow { axis 1 0 0 offset 0 1 0 boxmin -0.1 0 -0.1 boxmax 0.1 1 0.1 rxlimit -2 2 } }`,
  },
];

/** Each is one drop; a walk without files begins with the page's own example. */
export const DROPS: readonly (readonly (string | DroppedFile)[])[] = hasShared ? REAL : [OWN, []];

export function filesIn(drop: readonly (string | DroppedFile)[]): readonly DroppedFile[] {
  return drop.map((file) =>
    typeof file === 'string' ? { name: basename(file), bytes: sharedBytes(`data/${file}`) } : file,
  );
}
