import { describe, expect, it } from 'vitest';
import { mirrorTakes } from '../../../src/edit/commands/take-edits.ts';
import { reflectionOf } from '../../../src/edit/pose/reflection.ts';
import { framesBetween } from '../../../src/edit/samples/frames.ts';
import { mirroringTake } from '../../../src/edit/samples/take-mirror.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { poseAt } from '../../../src/evaluate/pose.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import type { Character } from '../../../src/model/document.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { restChannel, type Take } from '../../../src/model/takes/take.ts';
import { character, documentOf, joint, morph } from '../../helpers/builders.ts';
import { ALL_BVH, sharedCaptures } from '../../helpers/bvh-files.ts';
import { expectEdit } from '../../helpers/expect-edit.ts';
import { captured, personSkeleton, takeOfRoots } from '../../helpers/mocap.ts';
import { channelOf } from '../keys/channels.ts';

function mirrored(skeleton: Skeleton, take: Take, up: 'y' | 'z' = 'y'): Take {
  return runToEnd(mirroringTake({ skeleton, morphs: [], pose: filePose(skeleton, 0) }, take, up));
}

function framesOf(take: Take) {
  if (!take.samples) throw new Error(`${take.name} has no samples.`);
  return take.samples;
}

/** World matrices in a frame. */
function worldOf(skeleton: Skeleton, take: Take, frame: number): Float64Array {
  const { values, scales } = framesOf(take);
  const width = scales.length;
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(
    compiled,
    scales.map((scale, k) => values[frame * width + k] * scale),
    world,
  );
  return world;
}

/** The largest difference of two takes in the world, with every twentieth frame looked at. */
function worldApart(skeleton: Skeleton, a: Take, b: Take): number {
  let most = 0;
  for (let frame = 0; frame < framesOf(a).frameCount; frame += 20) {
    const theirs = worldOf(skeleton, b, frame);
    worldOf(skeleton, a, frame).forEach((v, k) => {
      most = Math.max(most, Math.abs(v - theirs[k]));
    });
  }
  return most;
}

/** How far the joints of a mirrored take are from the mirror image of their counterparts, both relative to the root. */
function offTheMirror(skeleton: Skeleton, take: Take, once: Take): number {
  const { partner } = reflectionOf(skeleton);
  const worst = [0, 0, 0];
  for (let frame = 0; frame < framesOf(take).frameCount; frame += 20) {
    const [was, is] = [worldOf(skeleton, take, frame), worldOf(skeleton, once, frame)];
    partner.forEach((t, s) => {
      if (t < 0) return;
      worst.forEach((_, axis) => {
        for (let k = 12; k < 15; k++) {
          const [theirs, own] = [was[16 * s + k] - was[k], is[16 * t + k] - is[k]];
          worst[axis] = Math.max(worst[axis], Math.abs(own - (k - 12 === axis ? -theirs : theirs)));
        }
      });
    });
  }
  // Across whichever plane it was.
  return Math.min(...worst);
}

/** By how much offsets differ from those of the other side, in whatever axes, all together. */
function lopsided(skeleton: Skeleton): number {
  const { partner } = reflectionOf(skeleton);
  const signs = [
    [-1, 1, 1],
    [1, -1, 1],
    [1, 1, -1],
    [-1, -1, -1],
  ];
  const apart = (s: number, t: number) => {
    const [from, to] = [skeleton.joints[s].offset, skeleton.joints[t].offset];
    return Math.min(...signs.map((sign) => Math.hypot(...sign.map((v, k) => v * from[k] - to[k]))));
  };
  return partner.reduce((sum, t, s) => (t >= 0 && s > 0 ? sum + apart(s, t) : sum), 0);
}

const WALKER = personSkeleton();
const WALK = takeOfRoots(
  WALKER,
  Array.from({ length: 20 }, (_, f) => [3 * f, 90, 20 * f] as const),
);
/** With the left knee bent, by column. */
const LIMPING: Take = {
  ...WALK,
  samples: { ...framesOf(WALK), values: framesOf(WALK).values.map((v, i) => (i % 21 === 13 ? 30 : v)) },
};

describe('mirroring a take', () => {
  it('mirroring a take exchanges the sides and reflects the path, in the numbers of the file', () => {
    const take = mirrored(WALKER, LIMPING);
    const { values } = framesOf(take);
    const before = framesOf(LIMPING).values;
    for (let f = 0; f < 20; f++) {
      const row = f * 21;
      expect([...values.subarray(row, row + 3)]).toEqual([-3 * f + 0, 90, 20 * f]);
      // The legs are joints 2 and 4, with three angles each from columns 9 and 15.
      expect([...values.subarray(row + 18, row + 21)].map(Math.abs)).toEqual(
        [...before.subarray(row + 12, row + 15)].map(Math.abs),
      );
    }
  });

  it('a take mirrored twice has every number again, and one that is symmetric stays the same object', () => {
    expect(mirrored(WALKER, mirrored(WALKER, LIMPING))).toEqual(LIMPING);
    const still = takeOfRoots(
      WALKER,
      Array.from({ length: 5 }, () => [0, 90, 0] as const),
    );
    expect(mirrored(WALKER, still)).toBe(still);
  });

  it('keys are mirrored with their tangents, and morphs by their names', () => {
    const skeleton: Skeleton = {
      name: 'hero',
      joints: [
        joint(-1, { name: 'body' }),
        joint(0, { name: 'arm_l', offset: [1, 0, 0] }),
        joint(0, { name: 'arm_r', offset: [-1, 0, 0] }),
      ],
    };
    const wave = channelOf([
      [0, 0.1],
      [0.5, 0.4, 0.5, 1],
      [1, 0.2],
    ]);
    // Root translation, 3 joints of 3 DOFs, 2 morphs.
    const channels = Array.from({ length: 14 }, (_, c) => ([0, 6, 8, 12].includes(c) ? wave : restChannel()));
    const hero: Character = character({
      skeleton,
      morphs: [morph('smile_l'), morph('smile_r')],
      takes: [{ name: 'hero_wave', range: [0, 1], channels }],
      shownTake: 0,
      pose: Array<number>(14).fill(0),
    });
    const args = { takes: [{ characterId: 'c1', take: 0 }] };
    const once = expectEdit(documentOf(hero), mirrorTakes, args).characters[0];
    const at = (of: Character, seconds: number) => {
      const out = new Float64Array(14);
      poseAt(of, seconds, out);
      return [...out];
    };
    for (const seconds of [0, 0.3, 0.7]) {
      const [was, now] = [at(hero, seconds), at(once, seconds)];
      expect(now[0]).toBeCloseTo(-was[0], 14);
      // About x the arms turn alike, about z against each other.
      expect([now[9], now[11]]).toEqual([was[6], -was[8]]);
      expect([now[6], now[8]].map(Math.abs)).toEqual([0, 0]);
      expect([now[12], now[13]]).toEqual([0, was[12]]);
    }
    expect(mirrorTakes.run(documentOf(once), args).characters[0].takes).toEqual(hero.takes);
  });

  it('several takes are mirrored in one step', () => {
    const two = documentOf(captured(WALKER, LIMPING), captured(WALKER, WALK, { id: 'c2', name: 'second' }));
    const refs = ['c1', 'c2'].map((characterId) => ({ characterId, take: 0 }));
    const after = expectEdit(two, mirrorTakes, { takes: refs });
    expect(after.characters.map(({ takes }) => framesOf(takes[0]).values[21])).toEqual([-3, -3]);
  });
});

describe('mirroring real takes', () => {
  for (const name of ALL_BVH) {
    it(`${name} mirrored shows each side where the other was, and mirrored twice is itself`, () => {
      for (const { skeleton, take: whole } of sharedCaptures(name)) {
        if (!whole?.samples) continue;
        const take = { ...whole, samples: framesBetween(whole.samples, 0, Math.min(60, whole.samples.frameCount)) };
        const { size } = reflectionOf(skeleton);
        const once = mirrored(skeleton, take);
        expect(worldApart(skeleton, mirrored(skeleton, once), take)).toBeLessThan(1e-6 * size);
        expect(offTheMirror(skeleton, take, once)).toBeLessThan(lopsided(skeleton) + 0.03 * size);
      }
    });
  }
});
