/** Balls and bones at levels of detail: the more there are, the fewer triangles each has. */
import { type BufferGeometry, CylinderGeometry, SphereGeometry } from 'three';

/** Few balls and bones have all their triangles, some a third of them, many a tenth of these. */
export type Level = 0 | 1 | 2;

export const LEVELS: readonly Level[] = [0, 1, 2];

/** From this many on, they are small on screen, and seventeen takes would be half a million triangles. */
const SOME = 400;
/** 20,000 joints would be two million triangles, and their ghosts twenty: ten seconds a frame without a GPU. */
const MANY = 4000;

/** Segments around and along a ball, and sides of a bone. */
const SHAPES: Readonly<Record<Level, readonly [around: number, along: number, sides: number]>> = {
  0: [16, 10, 12],
  1: [10, 6, 8],
  2: [4, 2, 3],
};

/** @param count of joints and End Sites */
export function levelFor(count: number): Level {
  if (count < SOME) return 0;
  return count < MANY ? 1 : 2;
}

/** Radius 1. */
export function ballGeometry(level: Level): BufferGeometry {
  const [around, along] = SHAPES[level];
  return new SphereGeometry(1, around, along);
}

/** From y = 0, radius 1, to y = 1, tapered; open, since the ends are inside the balls. */
export function boneGeometry(level: Level): BufferGeometry {
  return new CylinderGeometry(0.45, 1, 1, SHAPES[level][2], 1, true).translate(0, 0.5, 0);
}
