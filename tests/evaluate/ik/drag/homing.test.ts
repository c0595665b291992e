import { expect, it } from 'vitest';
import { shownAt } from '../../../../src/edit/rig/shown.ts';
import { Pull } from '../../../../src/evaluate/ik/drag/pull.ts';
import { pinPoints } from '../../../../src/evaluate/ik/pin-points.ts';
import { pinTargets, pointAt } from '../../../../src/evaluate/ik/set-up.ts';
import { worldMatrices } from '../../../../src/evaluate/kinematics.ts';
import { readSkel } from '../../../../src/formats/skel/read.ts';
import { readSkin } from '../../../../src/formats/skin/read.ts';
import { add, type Vec3, ZERO } from '../../../../src/math/vec3.ts';
import { boneEnds } from '../../../../src/model/bone-ends.ts';
import { type Character, shownSkin } from '../../../../src/model/document.ts';
import { filePose } from '../../../../src/model/dofs.ts';
import type { IkSetup } from '../../../../src/model/ik.ts';
import { character as builtCharacter } from '../../../helpers/builders.ts';
import { describeShared, sharedBytes } from '../../../helpers/shared.ts';

/** Radians, parts of the reach: the end of the last step home. */
const HOME = 2e-3;
/** What several joints off by that come to. */
const SEEN = 5e-3;
const FRAMES_TO_REST = 200;

function wasp(): Character {
  const [skeleton] = readSkel(sharedBytes('data/cse169/wasp.skel'), 'wasp.skel').value ?? [];
  const skin = readSkin(sharedBytes('data/cse169/wasp.skin'), 'wasp.skin').value;
  if (!skeleton || !skin) throw new Error('wasp could not be read');
  return builtCharacter({ skeleton, skins: [skin], pose: filePose(skeleton, 0) });
}

/** On all six feet. */
function pinned(character: Character): Character {
  const { skeleton } = character;
  if (!skeleton) throw new Error('no skeleton');
  const pins = skeleton.joints.flatMap(({ name }, joint) => {
    if (!name.startsWith('knee')) return [];
    const point = pinPoints(skeleton, joint, shownSkin(character)).find(({ kind }) => kind === 'skinEnd')?.point;
    return point ? [{ id: joint, joint, point, weight: 1, holdsOrientation: false }] : [];
  });
  const ik: IkSetup = { pins, stiff: [], rootIsFree: true };
  return { ...character, ik };
}

describeShared('a body that is led about on feet that hold', () => {
  it.each<[string, Vec3]>([
    ['up and out of reach', [0, 1.2, 0]],
    ['to the side', [1.2, 0, 0]],
    ['far away', [4, 3, 1]],
  ])('%s, is back where it was when the hand is', (_where, way) => {
    const character = pinned(wasp());
    const { skeleton, ik } = character;
    if (!skeleton || !ik) throw new Error('no skeleton');
    expect(ik.pins).toHaveLength(6);
    const { dofs, world } = shownAt(character, 0);
    const [x, y, z] = pointAt(world, 0, [0, 0, 0]);
    const grip = { joint: 0, point: [0, 0, 0] } as const;
    const pull = new Pull(character, skeleton, { dofs, world }, pinTargets(ik, world), grip);
    const to = (part: number) => pull.to([x + part * way[0], y + part * way[1], z + part * way[2]]);
    let furthest = 0;
    for (let f = 1; f <= 80; f++) {
      to(1 - Math.abs(f - 40) / 40);
      furthest = Math.max(furthest, off(pull.dofs, dofs));
    }
    for (let f = 0; f < FRAMES_TO_REST && pull.isOnItsWay; f++) to(0);
    expect(furthest).toBeGreaterThan(0.5);
    expect(off(pull.dofs, dofs)).toBeLessThan(HOME);
  });
});

/** Where the last joint's bone ends, out there and back in small steps, then until the pose is at rest. */
function thereAndBack(name: string, way: Vec3, far: number) {
  const [skeleton] = readSkel(sharedBytes(`data/axis-skel/${name}.axskel`), `${name}.axskel`).value ?? [];
  if (!skeleton) throw new Error(`${name} could not be read`);
  const character = builtCharacter({ skeleton, pose: filePose(skeleton, 0) });
  const { compiled, dofs, world } = shownAt(character, 0);
  const joint = skeleton.joints.length - 1;
  const point = boneEnds(skeleton).find((end) => end.joint === joint)?.at ?? ZERO;
  const pull = new Pull(character, skeleton, { dofs, world }, new Map(), { joint, point });
  const start = pull.hand;
  for (let f = 1; f <= 120; f++) pull.to(add(start, way, far * pull.reach * (1 - Math.abs(f - 60) / 60)));
  let frames = 0;
  for (; frames < FRAMES_TO_REST && pull.isOnItsWay; frames++) pull.goOn();
  const rest = pull.dofs.slice();
  for (let f = 0; f < 300; f++) pull.to(start);
  const now = new Float64Array(world.length);
  worldMatrices(compiled, pull.dofs, now);
  // Axes of joints, and places in parts of the reach.
  const differences = now.map((v, k) => Math.abs(v - world[k]) / (k % 16 < 12 ? 1 : pull.reach));
  return { frames, moved: off(pull.dofs, rest), away: Math.max(...differences) };
}

describeShared('an end that is led out and back', () => {
  const ways: readonly Vec3[] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, -1, 0],
    [0.6, -0.64, 0.48],
  ];
  it.each(['single', 'arm3', 'chain10', 'chain30', 'hand', 'hexapod', 'human', 'tree3'])(
    'dragging an end of %s out and back leaves the pose as it was',
    (name) => {
      for (const way of ways) {
        for (const far of [0.5, 1.5]) {
          const { frames, moved, away } = thereAndBack(name, way, far);
          expect(frames).toBeLessThan(60);
          expect(moved).toBeLessThan(HOME);
          expect(away, `${way} ${far}`).toBeLessThan(SEEN);
        }
      }
    },
  );
});

describeShared('an elbow that was led to its other side', () => {
  /** The arm, led straight and back by its hand, which is now still. */
  function led() {
    const [skeleton] = readSkel(sharedBytes('data/axis-skel/arm3.axskel'), 'arm3.axskel').value ?? [];
    if (!skeleton) throw new Error('arm3 could not be read');
    const character = builtCharacter({ skeleton, pose: filePose(skeleton, 0) });
    const { dofs, world } = shownAt(character, 0);
    const joint = skeleton.joints.length - 1;
    const point = boneEnds(skeleton).find((end) => end.joint === joint)?.at ?? ZERO;
    const pull = new Pull(character, skeleton, { dofs, world }, new Map(), { joint, point });
    const start = pull.hand;
    for (let f = 1; f <= 120; f++) pull.to(add(start, [1, 0, 0], pull.reach * (1 - Math.abs(f - 60) / 60)));
    return { pull, dofs, start };
  }

  it('an elbow on its other side is brought back within ten frames of a still hand, over several of them', () => {
    const { pull, dofs } = led();
    const far = off(pull.dofs, dofs);
    expect(far).toBeGreaterThan(1);
    let before = pull.dofs.slice();
    let frames = 0;
    for (; pull.isOnItsWay; frames++) {
      pull.goOn();
      expect(off(pull.dofs, before)).toBeLessThan(far / 3);
      before = pull.dofs.slice();
    }
    expect(frames).toBeLessThanOrEqual(10);
    expect(off(pull.dofs, dofs)).toBeLessThan(SEEN);
  });

  it('an elbow on its way back stays as it is seen if the hand lets go', () => {
    for (const frames of [0, 2, 4, 6]) {
      const { pull } = led();
      for (let f = 0; f < frames; f++) pull.goOn();
      const seen = pull.dofs.slice();
      pull.settle();
      expect(off(pull.dofs, seen), `${frames} frames`).toBeLessThan(HOME);
    }
  });

  it('an elbow on its way back follows a hand that moves on', () => {
    const { pull, start } = led();
    for (let f = 0; f < 3; f++) pull.goOn();
    const aside = add(start, [0, 0, 1], 0.05 * pull.reach);
    for (let f = 0; f < 20; f++) pull.to(aside);
    expect(pull.isOnItsWay).toBe(false);
    expect(pull.gaps()).toEqual([]);
  });
});

function off(a: Float64Array, b: ArrayLike<number>): number {
  return a.reduce((most, value, d) => Math.max(most, Math.abs(value - b[d])), 0);
}
