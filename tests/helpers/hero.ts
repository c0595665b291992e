/** The example walker as people get characters from elsewhere: with Mixamo's names for its joints, as VRM. */
import { readFileSync } from 'node:fs';
import { openFiles } from '../../src/files/open/open-files.ts';
import type { Character } from '../../src/model/document.ts';
import { EMPTY_DOCUMENT } from '../../src/model/document.ts';
import { parse } from '../../src/worker/parse.ts';
import type { GivenBlob } from '../../src/worker/protocol.ts';
import { type Glb, withJson } from './glb.ts';

const SAMPLES = new URL('../../public/samples/', import.meta.url);

/** Seconds. */
export const STRIDE = 1.6;

/** As the page comes with it. */
export const WALKER = ['rig', 'skel', 'skin', 'png'].map((extension) => `walker.${extension}`);
const MORPHS = ['blink', 'breathe', 'smile'].map((morph) => `walker_${morph}.morph`);
export const WALKER_FILES = [...WALKER, ...MORPHS, 'walker_walk.anim'].map((name) => ({
  name,
  bytes: new Uint8Array(readFileSync(new URL(name, SAMPLES))),
}));

/** Of the walker's joints: Mixamo's names, and VRM's. */
const sides = (s: 'l' | 'r', side: 'Left' | 'Right') => {
  const vrm = side === 'Left' ? 'left' : 'right';
  return [
    [`thigh_${s}`, `${side}UpLeg`, `${vrm}UpperLeg`],
    [`shin_${s}`, `${side}Leg`, `${vrm}LowerLeg`],
    [`foot_${s}`, `${side}Foot`, `${vrm}Foot`],
    [`toe_${s}`, `${side}ToeBase`, `${vrm}Toes`],
    [`upper_arm_${s}`, `${side}Arm`, `${vrm}UpperArm`],
    [`forearm_${s}`, `${side}ForeArm`, `${vrm}LowerArm`],
    [`hand_${s}`, `${side}Hand`, `${vrm}Hand`],
  ] as const;
};
const NAMES: readonly (readonly [own: string, mixamo: string, vrm: string])[] = [
  ['hips', 'Hips', 'hips'],
  ['spine', 'Spine', 'spine'],
  ['chest', 'Spine1', 'chest'],
  ['neck', 'Neck', 'neck'],
  ['head', 'Head', 'head'],
  ...sides('l', 'Left'),
  ...sides('r', 'Right'),
];
const MIXAMO = new Map(NAMES.map(([own, mixamo]) => [own, `mixamorig:${mixamo}`]));

/** The walker's files, again and again under names of their own. */
export function walkerFiles(count: number): GivenBlob[] {
  const decoder = new TextDecoder();
  return Array.from({ length: count }, (_, i) => `w${i}`).flatMap((name) =>
    WALKER_FILES.filter((file) => name === 'w0' || !file.name.endsWith('.png')).map((file) => {
      const isRig = file.name.endsWith('.rig');
      const content = isRig ? decoder.decode(file.bytes).replaceAll(/walker(?!\.png)/g, name) : file.bytes;
      const path = file.name.endsWith('.png') ? file.name : file.name.replace('walker', name);
      return { path, blob: new Blob([content]) };
    }),
  );
}

/**
 * The walker with its skin, morphs, texture and the first stride of its walk; its joints have Mixamo's names.
 * @param seconds of the walk, for which curves are fitted where it is written
 */
export async function hero(seconds = STRIDE): Promise<Character> {
  const files = WALKER_FILES.map(({ name, bytes }) => ({ path: name, blob: new Blob([bytes]) }));
  const read = await parse({ files }, () => undefined);
  const [walker] = openFiles(EMPTY_DOCUMENT, read.files).document.characters;
  if (!walker?.skeleton) throw new Error('The walker was expected.');
  const joints = walker.skeleton.joints.map((joint) => ({ ...joint, name: MIXAMO.get(joint.name) ?? joint.name }));
  const takes = walker.takes.map((take) => ({ ...take, name: 'stride', range: [0, seconds] as const }));
  return { ...walker, name: 'hero', skeleton: { ...walker.skeleton, joints }, takes };
}

/** As VRM 1.0: a GLB of it with the parts of the body. */
export function vrmOf(glb: Glb): Uint8Array<ArrayBuffer> {
  const nodeOf = new Map(glb.json.nodes.map(({ name }, node) => [name, node]));
  const humanBones = Object.fromEntries(
    NAMES.map(([own, , vrm]) => [vrm, { node: nodeOf.get(MIXAMO.get(own)) }] as const),
  );
  return withJson(glb, {
    extensionsUsed: ['VRMC_vrm'],
    extensions: { VRMC_vrm: { specVersion: '1.0', humanoid: { humanBones } } },
  });
}
