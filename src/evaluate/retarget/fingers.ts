/** Where fingers begin. */
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { BodyParts } from './roles.ts';

/** Fingers by the names that joints give them, from the thumb outwards. */
export const FINGERS = ['thumb', 'index', 'middle', 'ring', 'pinky'] as const;
/** A finger; see `FINGERS`. */
export type Finger = (typeof FINGERS)[number];

/**
 * The first joint of each finger of a hand but the thumb, which points elsewhere: the one with number 1, as bones
 * within the palm have none, else the first of its name.
 */
export function fingerBases({ joints }: Skeleton, { names }: BodyParts, hand: number): ReadonlyMap<Finger, number> {
  const out = new Map<Finger, number>();
  const below = new Set([hand]);
  for (let j = hand + 1; j < joints.length && below.has(joints[j].parent); j++) {
    below.add(j);
    const { word, number } = names[j];
    const finger = FINGERS.find((name) => name === word);
    if (finger === undefined || finger === 'thumb') continue;
    const known = out.get(finger);
    if (known === undefined || (number === 1 && names[known].number !== 1)) out.set(finger, j);
  }
  return out;
}
