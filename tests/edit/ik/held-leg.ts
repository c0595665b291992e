import type { HoldPins } from '../../../src/edit/commands/hold.ts';
import { pinPoint } from '../../../src/edit/commands/ik.ts';
import { Store } from '../../../src/edit/store.ts';
import { pointAt, reachOfSkeleton } from '../../../src/evaluate/ik/set-up.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Character } from '../../../src/model/document.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { type Channel, restChannel, type Take } from '../../../src/model/takes/take.ts';
import { character, documentOf, joint } from '../../helpers/builders.ts';
import { channelOf } from '../keys/channels.ts';

/** A hip, a knee, a foot, and an arm that has no part in it. 3 + 12 DOFs. */
export const LEG: Skeleton = {
  name: 'leg',
  joints: [
    joint(-1, { name: 'hip' }),
    joint(0, { name: 'knee', offset: [0, -1, 0] }),
    joint(1, { name: 'foot', offset: [0, -1, 0] }),
    joint(0, { name: 'arm', offset: [1, 0, 0] }),
  ],
};
export const REACH = reachOfSkeleton(LEG);
export const FOOT = 2;
/** What is stated of it. */
export const TOLERANCE = 1e-3 * REACH;

export const swing = (height: number, phase: number): Channel =>
  channelOf(Array.from({ length: 9 }, (_, k) => [k / 4, height * Math.sin(1.5 * k + phase)] as const));

/** Bent at the knee, swinging; two seconds. */
export function walk(): Take {
  const all: Channel[] = Array.from({ length: 15 }, () => restChannel());
  all[0] = swing(0.1, 0);
  all[3] = swing(0.2, 1);
  all[6] = channelOf(Array.from({ length: 9 }, (_, k) => [k / 4, 0.9 + 0.2 * Math.sin(k)] as const));
  all[12] = swing(0.5, 2);
  return { name: 'walk', range: [0, 2], channels: all };
}

export function store(more: Partial<Character> = {}): Store {
  const made = new Store(documentOf(character({ skeleton: LEG, takes: [walk()], shownTake: 0, ...more })));
  made.apply(pinPoint, { characterId: 'c1', joint: FOOT, point: [0, 0, 0] });
  return made;
}

export const HOLD: HoldPins = { characterId: 'c1', pins: [1], range: [0.5, 1], atSeconds: 0.5, framesPerSecond: 30 };
export const shown = (s: Store): Character => s.document.characters[0];
export const takeOf = (s: Store): Take => shown(s).takes[0];

export function footAt(c: Character, seconds: number, j = FOOT, point: Vec3 = [0, 0, 0]): Vec3 {
  if (!c.skeleton) throw new Error('no skeleton');
  const compiled = compileSkeleton(c.skeleton);
  const dofs = new Float64Array(dofCountOf(c));
  const world = new Float64Array(16 * compiled.jointCount);
  poseAt(c, seconds, dofs);
  worldMatrices(compiled, dofs, world);
  return pointAt(world, j, point);
}

export const apart = (a: Vec3, b: Vec3) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** The furthest that the foot gets from a place, at any time between. */
export function slide(c: Character, place: Vec3, from: number, to: number): number {
  let worst = 0;
  for (let i = 0; i <= 200; i++) worst = Math.max(worst, apart(footAt(c, from + ((to - from) * i) / 200), place));
  return worst;
}

export function valuesAt(c: Character, seconds: number): number[] {
  const dofs = new Float64Array(dofCountOf(c));
  poseAt(c, seconds, dofs);
  return [...dofs];
}
