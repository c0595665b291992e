/**
 * Skeletons for formats that have no DOFs of lengths: End Sites of bones that a DOF lengthens are where a take has
 * them, or, where it moves them, joints of their own.
 */
import { add } from '../math/vec3.ts';
import type { Character } from '../model/document.ts';
import { firstDofs } from '../model/skeleton/dofs.ts';
import { type AcclaimMotion, type Joint, NO_BOX, type Skeleton } from '../model/skeleton/skeleton.ts';
import { stretchOf } from '../model/skeleton/stretch.ts';
import { eachFrame, type Frames } from './bake.ts';
import { hasStretches } from './end-sites.ts';

const STANDS: AcclaimMotion = { kind: 'acclaim', dofs: [], axes: [0, 0, 0], order: 'xyz', frame: 'bone' };

/**
 * The skeleton with the ends of its bones as its character plays them; the same object if no DOF lengthens a bone. It
 * has the DOFs of the other one.
 * @param character with this skeleton
 * @param frames seconds of its take
 */
export function withPlayedEnds(character: Character, skeleton: Skeleton, frames: Frames): Skeleton {
  if (!hasStretches(skeleton)) return skeleton;
  const { joints } = skeleton;
  const starts = firstDofs(skeleton);
  const stretches = joints.map(stretchOf);
  const lengths = new Float64Array(joints.length);
  const isMoving = new Uint8Array(joints.length);
  eachFrame(character, frames, (dofs, frame) => {
    stretches.forEach((stretch, j) => {
      const by = stretch ? dofs[starts[j] + stretch.dof] : 0;
      if (frame === 0) lengths[j] = by;
      else if (by !== lengths[j]) isMoving[j] = 1;
    });
  });
  const made: Joint[] = [];
  const numbers = new Int32Array(joints.length);
  joints.forEach((joint, j) => {
    const { name, parent, endSites = [], ...rest } = joint;
    const own = { ...rest, name, parent: parent < 0 ? parent : numbers[parent] };
    numbers[j] = made.length;
    const stretch = stretches[j];
    if (!stretch || !isMoving[j]) {
      const ends = stretch ? endSites.map((end) => add(end, stretch.along, lengths[j])) : endSites;
      made.push({ ...own, ...(ends.length > 0 && { endSites: ends }) });
      return;
    }
    made.push(own);
    endSites.forEach((offset, e) => {
      const number = endSites.length > 1 ? e + 1 : '';
      const end = { name: `${name}_end${number}`, parent: numbers[j], offset, box: NO_BOX, motion: STANDS };
      made.push({ ...end, limits: [], pose: [], endSites: [[0, 0, 0]] });
    });
  });
  return { ...skeleton, joints: made };
}
