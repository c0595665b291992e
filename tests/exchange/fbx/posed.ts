/** Characters of FBX files, and where their joints and vertices are. */
import { newCharacter } from '../../../src/edit/new-character.ts';
import { blendMorphs, compileSkin, deform } from '../../../src/evaluate/deform.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { poseAt } from '../../../src/evaluate/pose.ts';
import { fbxReader } from '../../../src/exchange/fbx/read.ts';
import { toCharacter } from '../../../src/exchange/to-character.ts';
import { readWhole } from '../../../src/formats/reader.ts';
import { filePose } from '../../../src/model/dofs.ts';
import type { WholeCharacter } from '../../../src/model/files.ts';

export function characterOf(bytes: Uint8Array): WholeCharacter {
  const { value } = readWhole(fbxReader('file.fbx'), bytes);
  const character = value && toCharacter(value);
  if (!character) throw new Error('not read');
  return character;
}

/** World matrices of all joints, and all vertices. */
export function posed({ skeleton, morphs, skins, clips }: WholeCharacter, take: number, time: number) {
  const pose = filePose(skeleton, morphs.length);
  const values = Float64Array.from(pose);
  poseAt({ ...newCharacter('a', 'a'), skeleton, morphs, clips, pose, shownClip: take }, time, values);
  const compiled = compileSkeleton(skeleton);
  const worlds = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, values, worlds);
  const skin = skins.at(0);
  if (!skin) return { worlds, positions: new Float64Array(0) };
  const compiledSkin = compileSkin(skin);
  const positions = new Float64Array(skin.positions.length);
  const normals = new Float64Array(skin.positions.length);
  blendMorphs(compiledSkin, morphs, values, values.length - morphs.length, positions, normals);
  deform(compiledSkin, worlds, positions, normals, positions, normals);
  return { worlds, positions };
}
