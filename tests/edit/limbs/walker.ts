/** The walking example with its take, for tests of limbs. */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Change } from '../../../src/edit/change.ts';
import type { Command } from '../../../src/edit/command.ts';
import { addLimb } from '../../../src/edit/commands/beside/limbs.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { provideLayers } from '../../../src/evaluate/layers.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { readAnim } from '../../../src/formats/anim/read.ts';
import { readSkel } from '../../../src/formats/skel/read.ts';
import type { Character, Document } from '../../../src/model/document.ts';
import { character, documentOf } from '../../helpers/builders.ts';
import { expectEdit } from '../../helpers/expect-edit.ts';

provideLayers();

const bytes = (name: string) =>
  readFileSync(fileURLToPath(new URL(`../../../public/samples/${name}`, import.meta.url)));

const [skeleton] = readSkel(bytes('walker.skel'), 'walker.skel').value ?? [];
const take = readAnim(bytes('walker_walk.anim'), 'walker_walk.anim').value;
export const WALKER = { ...skeleton, name: 'walker' };

export const jointCalled = (name: string) => WALKER.joints.findIndex((one) => one.name === name);
export const LEG = ['thigh_l', 'shin_l', 'foot_l'].map(jointCalled);
export const HERO = { characterId: 'c1' } as const;

/** The walker, which walks. */
export function walking(): Document {
  if (!take) throw new Error('The take of the example can’t be read.');
  return documentOf(character({ skeleton: WALKER, takes: [{ ...take, name: 'walk' }], shownTake: 0 }));
}

/** The walker with its legs as limbs that take the goal's rotation. */
export function withLegs(document: Document = walking()): Document {
  return expectEdit(document, addLimb, { ...HERO, joints: LEG, orient: true, mirrored: true, name: 'leg_l' });
}

export const heroOf = ({ characters: [hero] }: Document): Character => hero;

/** The world matrices of the pose that is shown. */
export function worldAt(document: Document, timeSeconds: number): Float64Array {
  const hero = heroOf(document);
  const dofs = new Float64Array(dofCountOf(hero));
  poseAt(hero, timeSeconds, dofs);
  const world = new Float64Array(16 * WALKER.joints.length);
  worldMatrices(compileSkeleton(WALKER), dofs, world);
  return world;
}

export function run<A>(document: Document, command: Command<A, Document | Change>, args: A): Document {
  return expectEdit(document, command, args);
}
