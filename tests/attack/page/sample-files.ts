/** Files of every kind that the page reads, made here. Each entry is one drop. */
import { readFileSync } from 'node:fs';
import { zipFiles } from '../../../src/io/zip-files.ts';
import type { DroppedFile } from '../../helpers/page.ts';
import { walkingBones } from '../../import/fbx/walking-bones.ts';
import { fbxBytes, fbxText } from '../../import/fbx/write-fbx.ts';
import { GltfMaker, glbOf } from '../../import/make-gltf.ts';

const SAMPLES = new URL('../../../public/samples/', import.meta.url);
const sample = (name: string): DroppedFile => ({ name, bytes: new Uint8Array(readFileSync(new URL(name, SAMPLES))) });

/** Skinned, morphed and textured. */
export const WALKER_DROP: readonly DroppedFile[] = [
  ...['rig', 'skel', 'skin', 'png'].map((extension) => sample(`walker.${extension}`)),
  ...['smile.morph', 'blink.morph', 'breathe.morph', 'walk.anim'].map((end) => sample(`walker_${end}`)),
];

const POST = 'balljoint post { boxmin 0 0 0 boxmax 1 3 1 }';

/** A capture of two joints. @param frames at 30 frames per second */
export function captureOf(frames: number): string {
  const rows = Array.from({ length: frames }, (_, i) => `0 ${i % 7} 0 ${i % 90} 0 0 ${i % 45} 0 0`);
  return `HIERARCHY
ROOT hips { OFFSET 0 0 0 CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT chest { OFFSET 0 20 0 CHANNELS 3 Zrotation Xrotation Yrotation
    End Site { OFFSET 0 20 0 } } }
MOTION
Frames: ${frames}
Frame Time: 0.033333
${rows.join('\n')}
`;
}

export const DROPS: Readonly<Record<string, readonly DroppedFile[]>> = {
  skel: [
    { name: 'post.skel', bytes: POST },
    { name: 'post.sets.json', bytes: '{"sets": [{"name": "all", "joints": ["#0"]}], "locked": []}' },
  ],
  walker: WALKER_DROP,
  axskel: [{ name: 'chain.axskel', bytes: '1 0 0 1 0 1\n1 0 1 0 0 0\n' }],
  bvh: [
    { name: 'capture.bvh', bytes: captureOf(60) },
    { name: 'capture.markers.json', bytes: '[{"time": 0.5, "label": "step"}]' },
  ],
  pose: [{ name: 'bent.pose', bytes: 'pose bent { }' }],
  glb: [{ name: 'pole.glb', bytes: pole() }],
  fbx: [
    { name: 'bones.fbx', bytes: fbxBytes(walkingBones) },
    { name: 'bones_text.fbx', bytes: fbxText(walkingBones) },
  ],
  dump: [{ name: 'world.txt', bytes: `world\n${'1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n'.repeat(2)}` }],
  zip: [{ name: 'both.zip', bytes: zipFiles('both', [{ name: 'zipped.skel', content: POST }]) }],
  broken: [{ name: 'broken.skel', bytes: 'balljoint broken { offset 0 0' }],
};

/** Two joints that turn, in a triangle. */
function pole(): Uint8Array<ArrayBuffer> {
  const maker = new GltfMaker();
  const POSITION = maker.add('VEC3', Float32Array.of(0, 0, 0, 1, 0, 0, 0, 2, 0));
  const JOINTS_0 = maker.add('VEC4', Uint8Array.of(0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0));
  const WEIGHTS_0 = maker.add('VEC4', Float32Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0));
  const input = maker.add('SCALAR', Float32Array.of(0, 1), { min: [0], max: [1] });
  const output = maker.add('VEC4', Float32Array.of(0, 0, 0, 1, 0, 0, 1, 0));
  return glbOf(
    maker.made({
      nodes: [
        { name: 'foot', children: [1] },
        { name: 'top', translation: [0, 1, 0] },
        { mesh: 0, skin: 0 },
      ],
      scenes: [{ nodes: [0, 2] }],
      scene: 0,
      skins: [{ joints: [0, 1] }],
      meshes: [{ primitives: [{ attributes: { POSITION, JOINTS_0, WEIGHTS_0 } }] }],
      animations: [
        {
          name: 'turn',
          samplers: [{ input, output }],
          channels: [{ sampler: 0, target: { node: 1, path: 'rotation' } }],
        },
      ],
    }),
  );
}
