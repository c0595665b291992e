/**
 * Joints that a drag moves: the joints that bend, and the feet that hold by themselves. Decided once, when it begins.
 */
import { ZERO } from '../../../math/vec3.ts';
import type { Character } from '../../../model/document.ts';
import type { Pin } from '../../../model/ik.ts';
import { lockedDofs } from '../../../model/sets.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { compileSkeleton } from '../../kinematics.ts';
import { type Bending, bendingOf, type IkReach, limbOf, union } from '../limb.ts';
import { ikOf } from '../set-up.ts';
import { standingFeet } from './standing-feet.ts';

/** Which DOFs a drag may move, and which feet it pins meanwhile. */
export interface DragReach {
  readonly bending: Bending;
  /** Pins for this drag alone, with ids of their own, after those of the settings. */
  readonly standing: readonly Pin[];
}

/** Everything bends, and only what is pinned holds. */
export const WHOLE: DragReach = { bending: 'body', standing: [] };

/**
 * Decides which joints a drag bends and which feet hold meanwhile.
 * @param world of the pose at the start, from `worldMatrices`
 * @param placement from the character's space to the scene's
 */
export function dragReach(
  character: Character,
  skeleton: Skeleton,
  world: Float64Array,
  placement: Float64Array,
  joint: number,
  reach: IkReach,
): DragReach {
  const bending = withPinned(character, skeleton, bendingOf(skeleton, joint, reach));
  if (bending !== 'body') return { bending, standing: [] };
  const { subtreeEnd } = compileSkeleton(skeleton);
  const { pins } = ikOf(character);
  const isIn = (other: number, foot: number) => other >= foot && other < subtreeEnd[foot];
  const feet = standingFeet(character, skeleton, world, placement).filter(
    (foot) => !isIn(joint, foot) && !pins.some((pin) => isIn(pin.joint, foot)),
  );
  const first = 1 + pins.reduce((most, { id }) => Math.max(most, id), 0);
  const standing = feet.map((foot, i): Pin => {
    return { id: first + i, joint: foot, point: ZERO, weight: 1, holdsOrientation: true };
  });
  return { bending, standing };
}

/** The number of locked DOFs of joints that could bend. */
export function lockedIn(character: Character, bending: Bending): number {
  const all = characterDofs(character.skeleton, []);
  return [...lockedDofs(character)].filter((dof) => bending === 'body' || bending.includes(all[dof].joint)).length;
}

/** The character with those pins besides its own. */
export function holding(character: Character, standing: readonly Pin[]): Character {
  if (standing.length === 0) return character;
  const ik = ikOf(character);
  return { ...character, ik: { ...ik, pins: [...ik.pins, ...standing] } };
}

/** Pinned limbs below what bends bend too, so that their pins hold: hands on a table while the chest is dragged. */
function withPinned(character: Character, skeleton: Skeleton, bending: Bending): Bending {
  if (bending === 'body' || bending.length === 0) return bending;
  const { subtreeEnd } = compileSkeleton(skeleton);
  const below = ikOf(character).pins.filter(({ joint }) => bending.some((j) => joint >= j && joint < subtreeEnd[j]));
  const limbs = below.map(({ joint }) => limbOf(skeleton, joint)).filter((limb) => limb !== 'body');
  return union([bending, ...limbs]);
}
