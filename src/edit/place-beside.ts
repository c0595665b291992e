/** Placement of new characters: beside existing ones, so that fifty dropped at once don't overlap. */

import { compileSkeleton, worldMatrices } from '../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../evaluate/pose.ts';
import { posedBounds, skinBounds } from '../evaluate/skin/bounds.ts';
import { compileSkin, skinMatrices } from '../evaluate/skin/deform.ts';
import { applySpace } from '../evaluate/space/space.ts';
import { type Character, DEFAULT_PLACEMENT, type Placement, shownSkin, shownTake } from '../model/document.ts';
import type { SourceFile } from '../model/files.ts';
import { perObject } from '../model/per-object.ts';
import { areBoxesOversized, hasBox } from '../model/skeleton/boxes.ts';

/** Gap between two characters, relative to the wider one. */
const GAP = 0.25;
/** Characters per row; all of a file count as one. */
const MAX_IN_ROW = 8;
/** Distance between rows, as a multiple of the largest character in both; leaves room to walk. */
const ROW_STEP = 1.5;
/** Distance of roots along z within one row, relative to the larger character. */
const SAME_ROW = 0.2;

/**
 * At the origin if nothing is there; else to the right (+x) of the characters in the last one's row; if the row is
 * full, at its left end in a new row in front (+z).
 *
 *     a  b  c  d  e  f  g  h
 *     i  j  k …                         z ↓ to the viewer
 *
 * Uses positions at the start of each take: a character that starts elsewhere on the ground (motion capture) is aligned
 * by its root. Characters of one file keep their relative positions.
 *
 * @param scale of its placement, unless it is placed with others of its file
 */
export function placeBeside(others: readonly Character[], character: Character, scale = 1): Placement {
  return new Placing(others).place(character, scale);
}

/** Places many characters one after the other, as `placeBeside`, without measuring all of them for each. */
export class Placing {
  private readonly characters: Character[] = [];
  private readonly firstOf = new FirstOfFiles();
  /** Per character: the first of its file, or itself; its row and size, or NaN before they are asked for. */
  private readonly leaders: number[] = [];
  private readonly rows: number[] = [];
  private readonly sizes: number[] = [];

  constructor(others: readonly Character[]) {
    for (const other of others) this.add(other);
  }

  /** With its placement. */
  add(character: Character): void {
    const i = this.characters.push(character) - 1;
    this.firstOf.add(character, i);
    this.leaders.push(this.firstOf.find(character) ?? i);
    this.rows.push(Number.NaN);
    this.sizes.push(Number.NaN);
  }

  /**
   * The placement of another character, beside those so far.
   * @param scale as of `placeBeside`
   */
  place(character: Character, scale = 1): Placement {
    const { characters, leaders, rows, sizes } = this;
    const together = this.firstOf.find(character);
    if (together !== undefined) return characters[together].placements[0];
    if (characters.length === 0) return { ...DEFAULT_PLACEMENT, scale };
    const own = scaled(extentOf(character), scale);
    const depth = character.space ? own.depth : 0;
    const row = this.measuredRow(leaders[leaders.length - 1]);
    let left = Number.POSITIVE_INFINITY;
    let right = Number.NEGATIVE_INFINITY;
    let widest = own.max - own.min;
    let largest = own.size;
    const inRow = new Set<number>();
    for (let i = 0; i < characters.length; i++) {
      const leader = leaders[i];
      if (Number.isNaN(rows[leader])) this.measuredRow(leader);
      if (!(Math.abs(rows[leader] - row) < SAME_ROW * Math.max(sizes[leader], own.size))) continue;
      inRow.add(leader);
      const inTheRow = characters[i];
      const extent = extentOf(inTheRow);
      widest = Math.max(widest, inTheRow.placements[0].scale * (extent.max - extent.min));
      largest = Math.max(largest, sizeOf(inTheRow));
      // An upper bound for rotated instances would need the depth; the width is close enough for a gap.
      for (const { position, scale } of inTheRow.placements) {
        left = Math.min(left, position[0] + scale * extent.min);
        right = Math.max(right, position[0] + scale * extent.max);
      }
    }
    const isFull = inRow.size >= MAX_IN_ROW;
    const x = isFull ? left - own.min : right + GAP * widest - own.min;
    const z = isFull ? row + ROW_STEP * largest - depth : row - depth;
    return { ...DEFAULT_PLACEMENT, position: [rounded(x), 0, rounded(z)], scale };
  }

  private measuredRow(leader: number): number {
    if (Number.isNaN(this.rows[leader])) {
      this.rows[leader] = rowOf(this.characters[leader]);
      this.sizes[leader] = sizeOf(this.characters[leader]);
    }
    return this.rows[leader];
  }
}

/** Which character with a space of its own is the first of each file, by its index in a list. */
class FirstOfFiles {
  private readonly firsts = new Map<SourceFile, number>();

  add(character: Character, index: number): void {
    const file = fileOf(character);
    if (file && !this.firsts.has(file)) this.firsts.set(file, index);
  }

  /** Undefined if none is from the file of this character, or it has no space. */
  find(character: Character): number | undefined {
    const file = fileOf(character);
    return file && this.firsts.get(file);
  }
}

/** File of the skeleton: textures and buffers may be those of many. */
function fileOf({ space, parts }: Character): SourceFile | undefined {
  return space && parts?.skeleton?.file?.source;
}

/** Maps a captured character to the first of `others` from the same file, and everything else to itself. */
export function leadersOf(others: readonly Character[]): (character: Character) => Character {
  const firstOf = new FirstOfFiles();
  for (const [i, other] of others.entries()) firstOf.add(other, i);
  return (character) => {
    const first = firstOf.find(character);
    return first === undefined ? character : others[first];
  };
}

/** Position of a character's row along the scene's z. */
function rowOf(character: Character): number {
  const [{ position, scale }] = character.placements;
  return position[2] + (character.space ? scale * extentOf(character).depth : 0);
}

function sizeOf(character: Character): number {
  return character.placements[0].scale * extentOf(character).size;
}

function rounded(length: number): number {
  // Of values near the largest number sums are infinite.
  return Number.isFinite(length) ? Number(length.toPrecision(4)) : 0;
}

/** The room that a character takes, in metres of the scene. */
export interface Extent {
  /** Along the scene's x, before its placement. */
  readonly min: number;
  readonly max: number;
  /** Position of its root along the scene's z. */
  readonly depth: number;
  /** Of its lowest point, along the scene's y. */
  readonly low: number;
  /** Along the scene's y. */
  readonly height: number;
  /** The longest side of its bounding box. */
  readonly size: number;
}

function scaled({ min, max, depth, low, height, size }: Extent, by: number): Extent {
  return { min: by * min, max: by * max, depth: by * depth, low: by * low, height: by * height, size: by * size };
}

/** Scratch; never escapes. */
const at = new Float64Array(3);

/** At the start of its take; cached per character. */
export const extentOf = perObject(measure);

function measure(character: Character): Extent {
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(character, (shownTake(character)?.range[0] ?? 0) - character.timeOffsetSeconds, dofs);
  const least = [Infinity, Infinity, Infinity];
  const most = [-Infinity, -Infinity, -Infinity];
  let depth = 0;
  const { skeleton, morphs, space } = character;
  const skin = shownSkin(character);
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
    // Others aren't drawn: a default box may be larger than the whole skin.
    const areDrawn = !skin && !areBoxesOversized(skeleton);
    skeleton.joints.forEach((joint, j) => {
      const { min, max } = joint.box;
      const isBoxed = areDrawn && hasBox(joint);
      // Extent of box and bone as if along x: an upper bound for any rotation.
      const boxReach = isBoxed ? Math.max(...min.map(Math.abs), ...max.map(Math.abs)) : 0;
      const reach = Math.max(boxReach, joint.length ?? 0);
      const o = 16 * j;
      reachTo(world[o + 12] - reach, world[o + 13], world[o + 14]);
      reachTo(world[o + 12] + reach, world[o + 13], world[o + 14]);
      for (let corner = 0; isBoxed && corner < 8; corner++) {
        const x = corner & 1 ? max[0] : min[0];
        const y = corner & 2 ? max[1] : min[1];
        const z = corner & 4 ? max[2] : min[2];
        const along = (k: number) => world[o + k] * x + world[o + 4 + k] * y + world[o + 8 + k] * z + world[o + 12 + k];
        reachTo(along(0), along(1), along(2));
      }
    });
    applySpace(space, world[12], world[13], world[14], at);
    depth = at[2];
  }
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
  // Between values near the largest number the difference is infinite.
  const span = (k: number) => Math.min(most[k] - least[k], Number.MAX_VALUE);
  return min <= max
    ? { min, max, depth, low: least[1], height: span(1), size: Math.max(span(0), span(1), span(2)) }
    : { min: 0, max: 0, depth, low: 0, height: 0, size: 0 };
}
