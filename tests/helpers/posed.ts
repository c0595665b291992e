/** Where the joints and vertices of a character of another program are. */

import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { poseAt } from '../../src/evaluate/pose.ts';
import { blendMorphs, compileSkin, deform } from '../../src/evaluate/skin/deform.ts';
import type { Character } from '../../src/model/document.ts';
import type { WholeCharacter } from '../../src/model/files.ts';
import { newCharacter } from '../../src/model/new-character.ts';
import { wholeFilePose } from '../../src/model/skeleton/dofs.ts';
import type { ReferencePose } from './gltf-reference.ts';

/**
 * World matrices of all joints, and all vertices of the first skin; in the file pose without a take.
 * @param as other than a new character
 */
export function posed(
  { skeleton, morphs, skins, takes }: WholeCharacter,
  take = -1,
  time = 0,
  as: Partial<Character> = {},
): ReferencePose {
  const pose = wholeFilePose(skeleton, morphs);
  const values = Float64Array.from(pose);
  poseAt({ ...newCharacter('a', 'a'), skeleton, morphs, takes, pose, shownTake: take, ...as }, time, values);
  const compiled = compileSkeleton(skeleton);
  const worlds = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, values, worlds);
  const skin = skins.at(0);
  if (!skin) return { worlds, positions: new Float64Array(0) };
  const compiledSkin = compileSkin(skin);
  const positions = new Float64Array(skin.positions.length);
  const normals = new Float64Array(skin.positions.length);
  blendMorphs(compiledSkin, morphs, values, values.length - morphs.length, positions, normals);
  deform(compiledSkin, worlds, positions, normals, positions, normals);
  return { worlds, positions };
}

/** The same with joints of nodes, without those that only this program has. */
export function posedNodes(whole: WholeCharacter, take = -1, time = 0): ReferencePose {
  const { worlds, positions } = posed(whole, take, time);
  const { joints } = whole.skeleton;
  const isOfNode = joints.map(
    ({ name, parent, motion }, j) =>
      !(motion.kind === 'fixed' && ((j === 0 && name === 'scene') || name === `${joints[parent]?.name}_bind`)),
  );
  return { worlds: worlds.filter((_, i) => isOfNode[i >> 4]), positions };
}

/** The largest distance of two joints or vertices, as a part of the size of the second pose; infinite if they differ in number. */
export function farthest(ours: ReferencePose, theirs: ReferencePose): number {
  if (ours.worlds.length !== theirs.worlds.length || ours.positions.length !== theirs.positions.length) return Infinity;
  const points = ({ worlds, positions }: ReferencePose) => [
    ...Array.from({ length: worlds.length / 16 }, (_, j) => [...worlds.subarray(16 * j + 12, 16 * j + 15)]),
    ...Array.from({ length: positions.length / 3 }, (_, v) => [...positions.subarray(3 * v, 3 * v + 3)]),
  ];
  const [a, b] = [points(ours), points(theirs)];
  const extent = [0, 1, 2].map((k) => {
    let [min, max] = [Infinity, -Infinity];
    for (const point of b) [min, max] = [Math.min(min, point[k]), Math.max(max, point[k])];
    return max - min;
  });
  const size = Math.hypot(...extent) || 1;
  let worst = 0;
  a.forEach((point, i) => {
    worst = Math.max(worst, Math.hypot(...point.map((value, k) => value - b[i][k])) / size);
  });
  // NaN counts as far.
  return Number.isNaN(worst) ? Infinity : worst;
}
