/** A small body for tests of rig commands, and what becomes of it. */
import { type Change, documentIn } from '../../../src/edit/change.ts';
import type { Command } from '../../../src/edit/command.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import type { Character, Document } from '../../../src/model/document.ts';
import type { Joint, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { character, documentOf, joint } from '../../helpers/builders.ts';

export const NEAR = 1e-9;

/** The first character after a command. */
export function done<A>(command: Command<A, Document | Change>, document: Document, args: A): Character {
  return documentIn(command.run(document, args)).characters[0];
}

export function jointsOf({ skeleton: own }: Character): readonly Joint[] {
  return own?.joints ?? [];
}

export const named = (parent: number, name: string, more: Partial<Joint> = {}) => joint(parent, { name, ...more });

/** hip – thigh – knee, and a tail. */
export const BODY: Skeleton = {
  name: 'hero',
  joints: [named(-1, 'hip'), named(0, 'thigh'), named(1, 'knee', { offset: [0, -1, 0] }), named(0, 'tail')],
};
export const body = (more: Partial<Character> = {}) => documentOf(character({ skeleton: BODY, ...more }));
export const of = (index: number) => ({ characterId: 'c1', joint: index });
export const namesIn = (c: Character) => jointsOf(c).map(({ name }) => name);

/** The world matrix of a joint, at 0 s. */
export function worldOf(c: Character, index: number): Float64Array {
  if (!c.skeleton) throw new Error('no skeleton');
  const dofs = new Float64Array(dofCountOf(c));
  poseAt(c, 0, dofs);
  const world = new Float64Array(16 * c.skeleton.joints.length);
  worldMatrices(compileSkeleton(c.skeleton), dofs, world);
  return world.slice(16 * index, 16 * index + 16);
}
