/** Where a new character stands: beside those that are there, so that fifty dropped at once are not one heap. */
import { posedBounds, skinBounds } from '../evaluate/bounds.ts';
import { compileSkin, skinMatrices } from '../evaluate/deform.ts';
import { compileSkeleton, worldMatrices } from '../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../evaluate/pose.ts';
import { applySpace } from '../evaluate/space.ts';
import { hasBox } from '../model/boxes.ts';
import { type Character, DEFAULT_PLACEMENT, type Placement, shownClip, shownSkin } from '../model/document.ts';

/** Room left between two characters, as a part of the wider one. */
const GAP = 0.25;

/**
 * At the origin where nothing stands there yet, else to the right (+x) of all others, at the moment where its clip
 * begins. One whose root is somewhere on the ground by then (captured motion) is put into a row with the last one.
 * Figures of one file keep their places to each other: they were there together.
 */
export function placeBeside(others: readonly Character[], character: Character): Placement {
  const together = others.find((o) => o.space && o.sources.some((s) => character.sources.includes(s)));
  if (together) return together.placements[0];
  const last = others.at(-1);
  if (!last) return DEFAULT_PLACEMENT;
  const own = extentOf(character);
  let right = Number.NEGATIVE_INFINITY;
  let widest = own.max - own.min;
  for (const other of others) {
    const extent = extentOf(other);
    widest = Math.max(widest, extent.max - extent.min);
    // A turned copy is as wide as its depth may be; its own width is near enough for a gap.
    for (const { position, scale } of other.placements) right = Math.max(right, position[0] + scale * extent.max);
  }
  const x = right + GAP * widest - own.min;
  const row = last.placements[0].position[2] + last.placements[0].scale * extentOf(last).depth;
  const z = character.space || last.space ? row - own.depth : 0;
  return { ...DEFAULT_PLACEMENT, position: [Number(x.toPrecision(3)), 0, Number(z.toPrecision(3)) || 0] };
}

export interface Extent {
  /** Along the scene's x, before its placement. */
  readonly min: number;
  readonly max: number;
  /** Where its root stands along the scene's z. */
  readonly depth: number;
}

/** Scratch, never escapes. */
const at = new Float64Array(3);

/** At the moment where its clip begins. */
export function extentOf(character: Character): Extent {
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(character, (shownClip(character)?.range[0] ?? 0) - character.timeOffsetSeconds, dofs);
  let min = Number.POSITIVE_INFINITY;
  let max = Number.NEGATIVE_INFINITY;
  let depth = 0;
  const { skeleton, morphs, space } = character;
  const reachTo = (x: number, y: number, z: number) => {
    applySpace(space, x, y, z, at);
    min = Math.min(min, at[0]);
    max = Math.max(max, at[0]);
  };
  const world = skeleton && new Float64Array(16 * skeleton.joints.length);
  if (skeleton && world) {
    worldMatrices(compileSkeleton(skeleton), dofs, world);
    skeleton.joints.forEach((joint, j) => {
      const { box } = joint;
      // The box's own reach, as if it lay along x: wide enough however it is turned.
      const reach = hasBox(joint) ? Math.max(...box.min.map(Math.abs), ...box.max.map(Math.abs)) : 0;
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
  return min <= max ? { min, max, depth } : { min: 0, max: 0, depth };
}
