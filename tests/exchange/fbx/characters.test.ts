/** Characters made of FBX files: their joints and vertices are where ufbx has those of the file, at all times. */
import { expect, it } from 'vitest';
import { newCharacter } from '../../../src/edit/new-character.ts';
import { blendMorphs, compileSkin, deform } from '../../../src/evaluate/deform.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { poseAt } from '../../../src/evaluate/pose.ts';
import { fbxReader } from '../../../src/exchange/fbx/read.ts';
import { toCharacter } from '../../../src/exchange/to-character.ts';
import { readWhole } from '../../../src/formats/reader.ts';
import { filePose } from '../../../src/model/dofs.ts';
import type { WholeCharacter } from '../../../src/model/files.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';
import { distance, type Expected, expectedOf, FBX_FILES, takeSize } from './expected.ts';

function characterOf(bytes: Uint8Array): WholeCharacter {
  const { value } = readWhole(fbxReader('file.fbx'), bytes);
  const character = value && toCharacter(value);
  if (!character) throw new Error('not read');
  return character;
}

/** World matrices of all joints, and all vertices. */
function posed({ skeleton, morphs, skins, clips }: WholeCharacter, take: number, time: number) {
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

/** How far the farthest joint and the farthest vertex are off, as parts of the size. */
function worstOf(character: WholeCharacter, { nodes: names, takes }: Expected): number {
  let worst = 0;
  for (const stated of takes) {
    const size = takeSize(stated);
    // Names of takes become names of files.
    const take = character.clips.findIndex(({ name }) => name === stated.name.replaceAll(/[| ]/g, '_'));
    expect(take).toBeGreaterThanOrEqual(0);
    const frames = stated.at.map(({ t }) => posed(character, take, t));
    for (const [f, { nodes }] of stated.at.entries()) {
      for (const [i, [name]] of names.entries()) {
        const joint = character.skeleton.joints.findIndex((own) => own.name === name.replaceAll(' ', '_'));
        expect(joint).toBeGreaterThanOrEqual(0);
        worst = Math.max(worst, distance(frames[f].worlds.subarray(16 * joint + 12), 0, nodes, i) / size);
      }
    }
    const count = (stated.at[0].vertices?.length ?? 0) / 3;
    for (let j = 0; j < count; j++) {
      let nearest = Number.POSITIVE_INFINITY;
      for (let i = 0; i < frames[0].positions.length / 3; i++) {
        let off = 0;
        for (const [f, { vertices = [] }] of stated.at.entries()) {
          off = Math.max(off, distance(frames[f].positions, i, vertices, j));
          if (off > nearest) break;
        }
        nearest = Math.min(nearest, off);
      }
      worst = Math.max(worst, nearest / size);
    }
  }
  return worst;
}

describeShared('characters of the public FBX files', () => {
  for (const name of FBX_FILES) {
    it(`${name}: joints and vertices of the character are where ufbx has them`, () => {
      const worst = worstOf(characterOf(sharedBytes(`data/fbx/${name}.fbx`)), expectedOf(name));
      expect(worst).toBeLessThan(1e-4);
    });
  }
});
