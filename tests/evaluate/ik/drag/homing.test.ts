import { expect, it } from 'vitest';
import { shownAt } from '../../../../src/edit/rig/shown.ts';
import { Pull } from '../../../../src/evaluate/ik/drag/pull.ts';
import { pinPoints } from '../../../../src/evaluate/ik/pin-points.ts';
import { pinTargets, pointAt } from '../../../../src/evaluate/ik/set-up.ts';
import { readSkel } from '../../../../src/formats/skel/read.ts';
import { readSkin } from '../../../../src/formats/skin/read.ts';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import { type Character, shownSkin } from '../../../../src/model/document.ts';
import { filePose } from '../../../../src/model/dofs.ts';
import type { IkSetup } from '../../../../src/model/ik.ts';
import { character as builtCharacter } from '../../../helpers/builders.ts';
import { describeShared, sharedBytes } from '../../../helpers/shared.ts';

/** Radians, parts of the reach: the end of the last step home. */
const HOME = 2e-3;
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

function off(a: Float64Array, b: ArrayLike<number>): number {
  return a.reduce((most, value, d) => Math.max(most, Math.abs(value - b[d])), 0);
}
