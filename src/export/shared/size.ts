/** A character's size: the diagonal of the box around its joints, End Sites, tips of bones and vertices. */

import { playedTake } from '../../evaluate/bake.ts';
import { endSitePositions, tipPosition } from '../../evaluate/end-sites.ts';
import { inTakes } from '../../evaluate/in-takes.ts';
import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { poseAt } from '../../evaluate/pose.ts';
import { blendMorphs, compileSkin, deform } from '../../evaluate/skin/deform.ts';
import type { Character } from '../../model/document.ts';
import { hasBox } from '../../model/skeleton/boxes.ts';
import type { Skin } from '../../model/skin.ts';

/**
 * The larger of those at rest and at the start of the take that plays; greater than 0.
 * @param rest all DOFs
 */
export function sizeOf(character: Character, skin: Skin | undefined, rest: Float64Array): number {
  const plain = inTakes(character);
  const size = diagonal(character, skin, rest);
  const takes = character.driver ? [playedTake(character)] : character.takes;
  const starts = takes.flatMap((take, shown) => {
    if (!take) return [];
    const dofs = new Float64Array(rest.length);
    const played = character.driver ? plain : { ...plain, shownTake: shown };
    poseAt({ ...played, timeOffsetSeconds: 0 }, take.range[0], dofs);
    return [diagonal(character, skin, dofs)];
  });
  const largest = Math.max(size, ...starts.slice(0, MANY));
  return largest > 0 ? largest : largestBox(character);
}

/** No box is as large in earnest. */
const FAR = 1e9;

/** Of a character that is one point, such as a sword of one joint. */
function largestBox({ skeleton }: Character): number {
  const diagonals = (skeleton?.joints ?? [])
    .filter(hasBox)
    .map(({ box: { min, max } }) => Math.hypot(...max.map((m, k) => m - min[k])));
  const largest = Math.max(0, ...diagonals.filter((diagonal) => diagonal < FAR));
  return largest > 0 ? largest : 1;
}

/** Takes of one character start alike; hundreds need not be looked at. */
const MANY = 20;

function diagonal({ skeleton, morphs }: Character, skin: Skin | undefined, dofs: Float64Array): number {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  const see = (points: ArrayLike<number>, o: number) => {
    for (let k = 0; k < 3; k++) {
      const value = points[o + k];
      if (value < min[k]) min[k] = value;
      if (value > max[k]) max[k] = value;
    }
  };
  let world: Float64Array | undefined;
  if (skeleton) {
    const matrices = new Float64Array(16 * skeleton.joints.length);
    worldMatrices(compileSkeleton(skeleton), dofs, matrices);
    skeleton.joints.forEach(({ length }, j) => {
      see(matrices, 16 * j + 12);
      if (length) see(tipPosition(length, matrices, j), 0);
    });
    for (const { position } of endSitePositions(skeleton, matrices, dofs)) see(position, 0);
    world = matrices;
  }
  if (skin) {
    const compiled = compileSkin(skin);
    const positions = new Float64Array(skin.positions.length);
    const normals = new Float64Array(skin.positions.length);
    blendMorphs(compiled, morphs, dofs, dofs.length - morphs.length, positions, normals);
    deform(compiled, world, positions, normals, positions, normals);
    for (let o = 0; o < positions.length; o += 3) see(positions, o);
  }
  const size = Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
  return Number.isFinite(size) ? size : 0;
}
