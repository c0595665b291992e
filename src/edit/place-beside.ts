/** Where a new character stands: beside those that are there, so that fifty dropped at once are not one heap. */
import { posedBounds, skinBounds } from '../evaluate/bounds.ts';
import { compileSkin, skinMatrices } from '../evaluate/deform.ts';
import { compileSkeleton, worldMatrices } from '../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../evaluate/pose.ts';
import { type Character, DEFAULT_PLACEMENT, type Placement, shownClip, shownSkin } from '../model/document.ts';

/** Room left between two characters, as a part of the wider one. */
const GAP = 0.25;

/**
 * At the origin where nothing stands there yet, else to the right (+x) of all others, at the moment where its clip
 * begins.
 */
export function placeBeside(others: readonly Character[], character: Character): Placement {
  if (others.length === 0) return DEFAULT_PLACEMENT;
  const own = extentX(character);
  let right = Number.NEGATIVE_INFINITY;
  let widest = own.max - own.min;
  for (const other of others) {
    const extent = extentX(other);
    widest = Math.max(widest, extent.max - extent.min);
    // A turned copy is as wide as its depth may be; its own width is near enough for a gap.
    for (const { position, scale } of other.placements) right = Math.max(right, position[0] + scale * extent.max);
  }
  const x = right + GAP * widest - own.min;
  return { ...DEFAULT_PLACEMENT, position: [Number(x.toPrecision(3)), 0, 0] };
}

function extentX(character: Character): { min: number; max: number } {
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(character, (shownClip(character)?.range[0] ?? 0) - character.timeOffsetSeconds, dofs);
  let min = Number.POSITIVE_INFINITY;
  let max = Number.NEGATIVE_INFINITY;
  const { skeleton, morphs } = character;
  const world = skeleton && new Float64Array(16 * skeleton.joints.length);
  if (skeleton && world) {
    worldMatrices(compileSkeleton(skeleton), dofs, world);
    skeleton.joints.forEach(({ box }, joint) => {
      // The box's own reach, as if it lay along x: wide enough however it is turned.
      const reach = Math.max(...box.min.map(Math.abs), ...box.max.map(Math.abs));
      min = Math.min(min, world[16 * joint + 12] - reach);
      max = Math.max(max, world[16 * joint + 12] + reach);
    });
  }
  const skin = shownSkin(character);
  if (skin) {
    const compiled = compileSkin(skin);
    const matrices = world && new Float64Array(16 * compiled.matrixCount);
    if (world && matrices) skinMatrices(compiled, world, matrices);
    const box = new Float64Array(6);
    posedBounds(skinBounds(skin, morphs), matrices, dofs, dofs.length - morphs.length, box);
    min = Math.min(min, box[0]);
    max = Math.max(max, box[3]);
  }
  return min <= max ? { min, max } : { min: 0, max: 0 };
}
