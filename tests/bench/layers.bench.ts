/**
 * A pose of a character of 31 joints, playing at 60 frames a second, under three layers against none. Goal: at most twice
 * the time, also if each layer touches every DOF; and the same for a whole frame, with matrices.
 */
import { bench, describe } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { provideLayers } from '../../src/evaluate/layers.ts';
import { poseFrom, poseSource } from '../../src/evaluate/pose.ts';
import { arranged } from '../../src/model/takes/layers.ts';
import {
  type Extrapolation,
  type KeyedChannel,
  type Layer,
  restChannel,
  type Take,
} from '../../src/model/takes/take.ts';
import { SMOOTH } from '../../src/model/takes/tangent-kinds.ts';
import { character, joint } from '../helpers/builders.ts';

const JOINTS = 31;
const CHANNELS = 3 + 3 * JOINTS;
const ARM = new Set(Array.from({ length: 12 }, (_, i) => 30 + i));
const FRAMES = 600;

provideLayers();

/** @param every seconds from key to key */
function channel(seed: number, keys: number, every: number, extrapolation: Extrapolation): KeyedChannel {
  const tangents = { kinds: new Uint8Array(keys).fill(SMOOTH), slopes: new Float64Array(keys) };
  return {
    ...{ kind: 'keys', extrapolateIn: extrapolation, extrapolateOut: extrapolation },
    times: Float64Array.from({ length: keys }, (_, k) => k * every + 0.001 * (seed % 7)),
    values: Float64Array.from({ length: keys }, (_, k) => Math.sin(seed + k)),
    ...{ tangentsIn: tangents, tangentsOut: tangents },
  };
}

const base: Take = {
  name: 'walk',
  range: [0, 10],
  channels: Array.from({ length: CHANNELS }, (_, c) => channel(c, 12, 0.1, 'cycle')),
};

function layer(seed: number, touched: (dof: number) => boolean, more: Partial<Layer> = {}): Layer {
  return {
    ...{ name: `layer ${seed}`, mode: 'additive', weight: 0.7, mute: false, solo: false, root: false, morphs: false },
    motion: {
      channels: base.channels.map((_, c) =>
        touched(c) ? channel(100 * seed + c, 10, 0.9 + 0.1 * seed, 'constant') : restChannel(),
      ),
    },
    ...more,
  };
}

const three = (touched: (dof: number) => boolean, more: Partial<Layer> = {}) =>
  arranged(
    base,
    base,
    [layer(1, touched, more), layer(2, touched, { ...more, mode: 'override' }), layer(3, touched, more)],
    -1,
  );

const fading = channel(0, 10, 0.7, 'constant');
const TAKES: readonly (readonly [name: string, take: Take])[] = [
  ['none', base],
  ['three of an arm', three((dof) => ARM.has(dof))],
  ['three of all DOFs', three(() => true)],
  ['three of an arm, weights keyed', three((dof) => ARM.has(dof), { weight: fading })],
  ['three of all DOFs, weights keyed', three(() => true, { weight: fading })],
];
const skeleton = {
  name: 'hero',
  joints: Array.from({ length: JOINTS }, (_, j) => joint(Math.floor((j - 1) / 2))),
};
const compiled = compileSkeleton(skeleton);
const worlds = new Float64Array(16 * JOINTS);
const pose = new Float64Array(CHANNELS);

for (const withMatrices of [false, true]) {
  describe(`${withMatrices ? 'poses and matrices' : 'poses'} of ${FRAMES} frames, layers:`, () => {
    for (const [name, take] of TAKES) {
      const source = poseSource(character({ skeleton, takes: [take], shownTake: 0 }));
      bench(name, () => {
        for (let f = 0; f < FRAMES; f++) {
          poseFrom(source, f / 60, pose);
          if (withMatrices) worldMatrices(compiled, pose, worlds);
        }
      });
    }
  });
}
