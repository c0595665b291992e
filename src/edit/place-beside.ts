/** Where a new character stands: beside those that are there, so that fifty dropped at once are not one heap. */
import { posedBounds, skinBounds } from '../evaluate/bounds.ts';
import { compileSkin, skinMatrices } from '../evaluate/deform.ts';
import { compileSkeleton, worldMatrices } from '../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../evaluate/pose.ts';
import { applySpace } from '../evaluate/space.ts';
import { hasBox } from '../model/boxes.ts';
import { type Character, DEFAULT_PLACEMENT, type Placement, shownClip, shownSkin } from '../model/document.ts';
import type { SourceFile } from '../model/files.ts';
import { perObject } from '../model/per-object.ts';

/** Room left between two characters, as a part of the wider one. */
const GAP = 0.25;
/** Characters in a row; all figures of a file count as one. */
const MAX_IN_ROW = 8;
/** From one row to the next, as a multiple of the largest in both: one can walk between them. */
const ROW_STEP = 1.5;
/** Roots so near to each other along z stand in one row, as a part of the larger character. */
const SAME_ROW = 0.2;

/**
 * At the origin where nothing stands there yet; else to the right (+x) of those in the last one's row; and where the
 * row is full, at its left end in a new row before it (+z).
 *
 *     a  b  c  d  e  f  g  h
 *     i  j  k …                         z ↓ to the viewer
 *
 * All as they stand at the moment where their clips begin: who is somewhere else on the ground by then (captured motion)
 * is put into the row with its root. Figures of one file keep their places to each other: they were there together.
 */
export function placeBeside(others: readonly Character[], character: Character): Placement {
  const leaderOf = leadersOf(others);
  const together = leaderOf(character);
  if (together !== character) return together.placements[0];
  const last = others.at(-1);
  if (!last) return DEFAULT_PLACEMENT;
  const own = extentOf(character);
  const depth = character.space ? own.depth : 0;
  const row = rowOf(leaderOf(last));
  const figures = others.filter((o) => {
    const leader = leaderOf(o);
    return Math.abs(rowOf(leader) - row) < SAME_ROW * Math.max(sizeOf(leader), own.size);
  });
  let left = Number.POSITIVE_INFINITY;
  let right = Number.NEGATIVE_INFINITY;
  let widest = own.max - own.min;
  let largest = own.size;
  for (const figure of figures) {
    const extent = extentOf(figure);
    widest = Math.max(widest, extent.max - extent.min);
    largest = Math.max(largest, sizeOf(figure));
    // A turned copy is as wide as its depth may be; its own width is near enough for a gap.
    for (const { position, scale } of figure.placements) {
      left = Math.min(left, position[0] + scale * extent.min);
      right = Math.max(right, position[0] + scale * extent.max);
    }
  }
  const isFull = new Set(figures.map(leaderOf)).size >= MAX_IN_ROW;
  const x = isFull ? left - own.min : right + GAP * widest - own.min;
  const z = isFull ? row + ROW_STEP * largest - depth : row - depth;
  return { ...DEFAULT_PLACEMENT, position: [rounded(x), 0, rounded(z)] };
}

/** Tells of a figure the first one among `others` of the file that captured it; itself of everything else. */
function leadersOf(others: readonly Character[]): (character: Character) => Character {
  const first = new Map<SourceFile, Character>();
  for (const other of others) {
    if (!other.space) continue;
    for (const source of other.sources) if (!first.has(source)) first.set(source, other);
  }
  return (character) => {
    const source = character.space && character.sources.find((s) => first.has(s));
    return (source && first.get(source)) ?? character;
  };
}

/** Where a character's row is along the scene's z. */
function rowOf(character: Character): number {
  const [{ position, scale }] = character.placements;
  return position[2] + (character.space ? scale * extentOf(character).depth : 0);
}

function sizeOf(character: Character): number {
  return character.placements[0].scale * extentOf(character).size;
}

function rounded(length: number): number {
  return Number(length.toPrecision(4)) || 0;
}

export interface Extent {
  /** Along the scene's x, before its placement. */
  readonly min: number;
  readonly max: number;
  /** Where its root stands along the scene's z. */
  readonly depth: number;
  /** The longest side of the box around it. */
  readonly size: number;
}

/** Scratch, never escapes. */
const at = new Float64Array(3);

/** At the moment where its clip begins; found once for each character. */
export const extentOf = perObject(measure);

function measure(character: Character): Extent {
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(character, (shownClip(character)?.range[0] ?? 0) - character.timeOffsetSeconds, dofs);
  const least = [Infinity, Infinity, Infinity];
  const most = [-Infinity, -Infinity, -Infinity];
  let depth = 0;
  const { skeleton, morphs, space } = character;
  const reachTo = (x: number, y: number, z: number) => {
    applySpace(space, x, y, z, at);
    for (let k = 0; k < 3; k++) {
      least[k] = Math.min(least[k], at[k]);
      most[k] = Math.max(most[k], at[k]);
    }
  };
  const world = skeleton && new Float64Array(16 * skeleton.joints.length);
  if (skeleton && world) {
    worldMatrices(compileSkeleton(skeleton), dofs, world);
    skeleton.joints.forEach((joint, j) => {
      const { box } = joint;
      // The box's own reach, and the bone's, as if they lay along x: wide enough however they are turned.
      const boxReach = hasBox(joint) ? Math.max(...box.min.map(Math.abs), ...box.max.map(Math.abs)) : 0;
      const reach = Math.max(boxReach, joint.length ?? 0);
      const o = 16 * j + 12;
      reachTo(world[o] - reach, world[o + 1], world[o + 2]);
      reachTo(world[o] + reach, world[o + 1], world[o + 2]);
    });
    applySpace(space, world[12], world[13], world[14], at);
    depth = at[2];
  }
  const skin = shownSkin(character);
  if (skin) {
    const compiled = compileSkin(skin);
    const matrices = world && new Float64Array(16 * compiled.matrixCount);
    if (world && matrices) skinMatrices(compiled, world, matrices);
    const box = new Float64Array(6);
    posedBounds(skinBounds(skin, morphs), matrices, dofs, dofs.length - morphs.length, box);
    reachTo(box[0], box[1], box[2]);
    reachTo(box[3], box[4], box[5]);
  }
  const [min] = least;
  const [max] = most;
  return min <= max
    ? { min, max, depth, size: Math.max(...most.map((m, k) => m - least[k])) }
    : { min: 0, max: 0, depth, size: 0 };
}
