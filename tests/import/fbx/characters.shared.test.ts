/** Characters made of FBX files: their joints and vertices are where ufbx has those of the file, at all times. */
import { expect, it } from 'vitest';
import type { WholeCharacter } from '../../../src/model/files.ts';
import { posed } from '../../helpers/posed.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';
import { distance, type Expected, expectedOf, FBX_FILES, takeSize } from './expected.ts';
import { characterOf } from './read-character.ts';

/** How far the farthest joint and the farthest vertex are off, as parts of the size. */
function worstOf(character: WholeCharacter, { nodes: names, takes }: Expected): number {
  let worst = 0;
  for (const stated of takes) {
    const size = takeSize(stated);
    // Names of takes become names of files.
    const take = character.takes.findIndex(({ name }) => name === stated.name.replaceAll(/[| ]/g, '_'));
    expect(take).toBeGreaterThanOrEqual(0);
    const frames = stated.at.map(({ t }) => posed(character, take, t));
    const joints = names.map(([name]) =>
      character.skeleton.joints.findIndex((own) => own.name === name.replaceAll(' ', '_')),
    );
    expect(joints).not.toContain(-1);
    for (const [f, { nodes }] of stated.at.entries()) {
      for (const [i, joint] of joints.entries()) {
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
