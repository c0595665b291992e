/** VRM animations as written, and how far their bones are from a take's. */
import { eachFrame } from '../../../src/evaluate/bake.ts';
import { retargetBody } from '../../../src/evaluate/retarget/body.ts';
import { writeVrma } from '../../../src/export/vrma/write.ts';
import { importFile } from '../../../src/files/imports.ts';
import type { Character } from '../../../src/model/document.ts';
import { posed } from '../../helpers/posed.ts';

interface Node {
  readonly name: string;
  readonly children?: readonly number[];
  readonly translation?: readonly number[];
  readonly rotation?: readonly number[];
}

/** A character as a VRM animation, with what is in the file. */
export function vrmaOf(own: Character) {
  const { pieces, report } = writeVrma(own, { body: true });
  const bytes = new Uint8Array(Buffer.concat(pieces));
  const json = JSON.parse(
    new TextDecoder().decode(bytes.subarray(20, 20 + new DataView(bytes.buffer).getUint32(12, true))),
  );
  const nodes: readonly Node[] = json.nodes;
  const bones: Readonly<Record<string, { readonly node: number }>> =
    json.extensions.VRMC_vrm_animation.humanoid.humanBones;
  const placeOf = (node: number): readonly number[] => {
    const above = nodes.findIndex(({ children }) => children?.includes(node));
    const own = nodes[node].translation ?? [0, 0, 0];
    return above < 0 ? own : placeOf(above).map((value, k) => value + own[k]);
  };
  return { bytes, report, json, nodes, bones, at: (bone: string) => placeOf(bones[bone].node) };
}

/** Degrees between the way from one bone to another and a direction. */
export function slant(
  { at }: ReturnType<typeof vrmaOf>,
  from: string,
  to: string,
  direction: readonly number[],
): number {
  const way = at(to).map((value, k) => value - at(from)[k]);
  const cos = way.reduce((sum, value, k) => sum + value * direction[k], 0) / Math.hypot(...way);
  return (180 / Math.PI) * Math.acos(Math.min(1, cos));
}

/** Bones of a file and joints of a take, at frames: the largest difference of the distance of two, in metres. */
export async function farthestDistance(own: Character, made: ReturnType<typeof vrmaOf>): Promise<number> {
  const read = await importFile('gltf', { fileName: 'x.vrma', bytes: made.bytes, beside: async () => undefined });
  if (read.value?.kind !== 'character' || !own.skeleton) throw new Error('A character was expected.');
  const [whole] = read.value.characters;
  const skeletonOfOurs = own.skeleton;
  const [start, end] = own.takes[0].range;
  const frames = { startSeconds: start, frameSeconds: (end - start) / 12, frameCount: 13 };
  const pairs = Object.values(made.bones).map(({ node }) => {
    const { name } = made.nodes[node];
    return [
      skeletonOfOurs.joints.findIndex((each) => each.name === name),
      whole.skeleton.joints.findIndex((each) => each.name === name),
    ];
  });
  let most = 0;
  eachFrame(own, frames, (dofs, frame) => {
    const { points } = retargetBody(skeletonOfOurs, own.space, dofs);
    const { worlds } = posed(whole, 0, frame * frames.frameSeconds);
    for (const [a, b] of pairs) {
      for (const [c, d] of pairs) {
        const ours = Math.hypot(...[0, 1, 2].map((k) => points[3 * a + k] - points[3 * c + k]));
        const theirs = Math.hypot(...[0, 1, 2].map((k) => worlds[16 * b + 12 + k] - worlds[16 * d + 12 + k]));
        most = Math.max(most, Math.abs(ours - theirs));
      }
    }
  });
  return most;
}
