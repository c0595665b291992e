// Bones of a scene of one's own, moved by an .anim: import { bonesOf } from './three-bones.mjs' in a page
import { localMatrices, poseAt } from 'marrow/evaluate';
import { readAnim, readSkel } from 'marrow/formats';
import { createCharacter } from 'marrow/model';
import { Bone } from 'three';

/** `root` is for scene.add; `update(seconds)` is for the animation loop, and allocates nothing. */
export function bonesOf(skel, anim) {
  const { skeleton, diagnostics } = readSkel(skel);
  const { take, diagnostics: more } = readAnim(anim);
  if (!skeleton || !take) throw new Error([...diagnostics, ...more][0].message);
  const character = createCharacter({ skeleton, takes: [take] });
  const bones = skeleton.joints.map(({ name }) => Object.assign(new Bone(), { name, matrixAutoUpdate: false }));
  skeleton.joints.forEach(({ parent }, joint) => {
    if (parent >= 0) bones[parent].add(bones[joint]);
  });
  const dofs = poseAt(character, 0);
  const local = localMatrices(skeleton, dofs);
  const update = (seconds) => {
    localMatrices(skeleton, poseAt(character, seconds, dofs), local);
    bones.forEach((bone, joint) => {
      bone.matrix.fromArray(local, 16 * joint);
      bone.matrixWorldNeedsUpdate = true;
    });
  };
  update(take.range[0]);
  return { root: bones[0], bones, range: take.range, update };
}
