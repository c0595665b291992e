/**
 * Poses and matrices of the walking example with both legs and arms in IK, and three layers, against none. They are a part
 * of a frame, whose whole `limbs-frame.bench.ts` measures.
 */
import { bench, describe } from 'vitest';
import { documentIn } from '../../src/edit/change.ts';
import { addLayer } from '../../src/edit/commands/beside/layers.ts';
import { addLimb, keyLimb, switchLimb } from '../../src/edit/commands/beside/limbs.ts';
import { keyPose } from '../../src/edit/commands/keying.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { poseFrom, poseSource } from '../../src/evaluate/pose.ts';
import type { Document } from '../../src/model/document.ts';
import { HERO, heroOf, jointCalled, LEG, WALKER, walking } from '../edit/limbs/walker.ts';

const FRAMES = 600;
const arm = ['upper_arm_l', 'forearm_l', 'hand_l'].map(jointCalled);

function withLimbs(document: Document): Document {
  let now = addLimb.run(document, { ...HERO, joints: LEG, orient: true, mirrored: true });
  now = addLimb.run(now, { ...HERO, joints: arm, mirrored: true });
  for (const limb of [0, 1, 2, 3]) {
    now = switchLimb.run(now, { ...HERO, timeSeconds: 0, limb, to: 'ik' });
    for (const timeSeconds of [0.3, 0.6, 0.9]) now = keyLimb.run(now, { ...HERO, timeSeconds, limb });
  }
  return now;
}

function withLayers(document: Document): Document {
  let now = document;
  for (let layer = 0; layer < 3; layer++) {
    now = documentIn(addLayer.run(now, HERO));
    const dofs = Array.from({ length: 12 }, (_, k) => 12 + k);
    for (const timeSeconds of [0, 0.4, 0.8]) now = documentIn(keyPose.run(now, { ...HERO, timeSeconds, dofs }));
  }
  return now;
}

const compiled = compileSkeleton(WALKER);
const worlds = new Float64Array(16 * WALKER.joints.length);
const DOCUMENTS: readonly (readonly [name: string, document: Document])[] = [
  ['none', walking()],
  ['four limbs in IK', withLimbs(walking())],
  ['four limbs in IK over three layers', withLayers(withLimbs(walking()))],
];

// Beyond a limit the solver of pins continues, which takes most of the time of a limb that is held there.
describe.each([true, false])(
  `poses and matrices of ${FRAMES} frames, limits enforced: %s, limbs:`,
  (clampsToLimits) => {
    for (const [name, document] of DOCUMENTS) {
      const source = poseSource({ ...heroOf(document), clampsToLimits });
      const pose = new Float64Array(source.count);
      bench(name, () => {
        for (let f = 0; f < FRAMES; f++) {
          poseFrom(source, f / 60, pose);
          worldMatrices(compiled, pose, worlds);
        }
      });
    }
  },
);
