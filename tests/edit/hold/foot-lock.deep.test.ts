import { describe, expect, it } from 'vitest';
import { lockFeet, lockFeetSteps } from '../../../src/edit/commands/take-edits.ts';
import { framesBetween } from '../../../src/edit/samples/frames.ts';
import { readFrame, takeOfFrames } from '../../../src/edit/samples/take-frames.ts';
import { feetOf } from '../../../src/evaluate/foot-contacts.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { metresPerUnit } from '../../../src/evaluate/space/metres.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { formatOf } from '../../../src/files/readers.ts';
import { type Character, EMPTY_DOCUMENT, shownTake } from '../../../src/model/document.ts';
import { read } from '../../formats/read-in-pieces.ts';
import { documentOf } from '../../helpers/builders.ts';
import { expectEdit } from '../../helpers/expect-edit.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';
import { sliding } from './sliding.ts';

const takes = [{ characterId: 'c1', take: 0 }];

/** How far a joint gets from its mean place between two times of the shown take; metres. */
function slideOf(character: Character, joint: number, from: number, to: number): number {
  const samples = shownTake(character)?.samples;
  if (!samples || !character.skeleton) throw new Error('no samples');
  const compiled = compileSkeleton(character.skeleton);
  const dofs = new Float64Array(samples.scales.length);
  const world = new Float64Array(16 * compiled.jointCount);
  const frame = (seconds: number) => Math.round((seconds - samples.startSeconds) / samples.frameSeconds);
  const points: number[][] = [];
  for (let f = frame(from); f <= frame(to); f++) {
    readFrame(samples, f, dofs);
    worldMatrices(compiled, dofs, world);
    points.push([...world.subarray(16 * joint + 12, 16 * joint + 15)]);
  }
  const mean = [0, 1, 2].map((k) => points.reduce((sum, p) => sum + p[k] / points.length, 0));
  const metres = character.space ? metresPerUnit(character.space) : 1;
  return metres * Math.max(...points.map((p) => Math.hypot(...p.map((v, k) => v - mean[k]))));
}

describe('locking feet', () => {
  it('feet that slide hold still, and only the legs move', () => {
    const hero = sliding(0.004);
    const after = expectEdit(documentOf(hero), lockFeet, { takes }).characters[0];
    for (const ball of feetOf(after.skeleton ?? { name: '', joints: [] }, after.space).balls) {
      expect(slideOf(hero, ball, 0, 1.1)).toBeGreaterThan(0.02);
      expect(slideOf(after, ball, 0, 1.1)).toBeLessThan(1e-6);
    }
    const [was, is] = [hero, after].map((c) => shownTake(c)?.samples?.values ?? new Float64Array(0));
    // The hips have 6 channels, the head the last 3 of 33.
    for (let f = 0; f < 12; f++) {
      expect(is.slice(33 * f, 33 * f + 6)).toEqual(was.slice(33 * f, 33 * f + 6));
      expect(is.slice(33 * f + 30, 33 * f + 33)).toEqual(was.slice(33 * f + 30, 33 * f + 33));
    }
  });

  it('a take whose feet hold still already is the same object, and so is one that was locked', () => {
    const still = documentOf(sliding(0));
    expect(lockFeet.run(still, { takes })).toBe(still);
    const locked = lockFeet.run(documentOf(sliding(0.004)), { takes });
    expect(lockFeet.run(locked, { takes })).toBe(locked);
  });

  it('a skeleton without legs and a negative ease are refused', () => {
    const hero = sliding(0.004);
    expect(() => lockFeet.run(documentOf(hero), { takes, easeSeconds: -1 })).toThrow('negative');
    const skeleton = { name: 'stick', joints: hero.skeleton?.joints.slice(0, 1) ?? [] };
    expect(() => lockFeet.run(documentOf({ ...hero, skeleton }), { takes })).toThrow('thigh, a shin and a foot');
  });
});

describeShared('locking feet of real takes', () => {
  for (const name of ['mixamo-names.bvh', 'cmu-01_01.bvh', 'xsens-armchair.bvh', 'bandai-namco-bow-normal.bvh']) {
    it(`feet of ${name} slide less than a millimetre in every contact`, () => {
      expect(formatOf(name)?.kind).toBe('bvh');
      const { value } = read(name, sharedBytes(`data/bvh/${name}`));
      if (!value) throw new Error(`${name} was not read.`);
      const source = { name, path: name, bytes: 1 };
      const [opened] = openFiles(EMPTY_DOCUMENT, [{ ...value, source }], []).document.characters;
      const [whole] = opened.takes;
      if (!whole.samples) throw new Error(`${name} has no samples.`);
      const take = takeOfFrames(whole, framesBetween(whole.samples, 0, Math.min(150, whole.samples.frameCount)));
      const hero = { ...opened, takes: [take] };
      const { document, contacts, unreached } = runToEnd(
        lockFeetSteps(documentOf(hero), { takes: [{ characterId: hero.id, take: 0 }] }),
      );
      expect(contacts.length).toBeGreaterThan(0);
      expect(unreached).toBe(0);
      for (const { joint, from, to } of contacts) {
        expect(slideOf(document.characters[0], joint, from, to)).toBeLessThan(1e-3);
      }
    });
  }
});
