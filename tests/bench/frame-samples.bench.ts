/**
 * A frame of 50 characters of 70 joints with 1,000 frames of samples each, as the page plays them: sampled through the
 * mixer into DOFs, then matrices. Against bare loops over the same typed arrays, without look-ups: one does the same
 * (sine and cosine of six half angles per frame and joint, slerp, matrix of the quaternion, product of affine
 * matrices), the other interpolates angles linearly, which is wrong, but the minimum. Goal: at most 3 times the first.
 */
import { bench, describe } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { RADIANS_PER_DEGREE } from '../../src/math/degrees.ts';
import type { Joint } from '../../src/model/skeleton/skeleton.ts';
import { INTERPOLATIONS, type Interpolation } from '../../src/model/takes/samples.ts';
import { SAMPLED, type Take } from '../../src/model/takes/take.ts';
import { PosePlayer } from '../../src/view/motion/pose-track.ts';
import { character, joint } from '../helpers/builders.ts';
import { bareCrowd } from './bare-crowd.ts';

const CHARACTERS = 50;
const JOINTS = 70;
const FRAMES = 1000;
const FRAME_SECONDS = 1 / 120;
const WIDTH = 3 + 3 * JOINTS;

/** Pseudorandom numbers, the same in every run. */
function* noise(seed: number): Generator<number, never> {
  let state = seed;
  while (true) {
    state = (Math.imul(state, 1664525) + 1013904223) | 0;
    yield (state >>> 0) / 2 ** 32;
  }
}

const skeleton = {
  name: 'hero',
  joints: Array.from({ length: JOINTS }, (_, j): Joint => {
    const turns = ['rz', 'rx', 'ry'] as const;
    const channels = j === 0 ? (['tx', 'ty', 'tz', ...turns] as const) : turns;
    const none = { min: -100000, max: 100000 };
    return joint(j === 0 ? -1 : Math.floor((j - 1) / 2), {
      motion: { kind: 'bvh', channels, positions: 'replace' },
      limits: channels.map(() => none),
      pose: channels.map(() => 0),
    });
  }),
};

/** A random walk in degrees, up to 2° per frame. */
function walk(seed: number, interpolation: Interpolation): Take {
  const random = noise(seed);
  const values = new Float64Array(WIDTH * FRAMES);
  for (let i = 0; i < values.length; i++) {
    values[i] = (i < WIDTH ? 0 : values[i - WIDTH]) + 4 * random.next().value - 2;
  }
  return {
    name: 'walk',
    range: [0, (FRAMES - 1) * FRAME_SECONDS],
    channels: Array.from({ length: WIDTH }, () => SAMPLED),
    samples: {
      frameCount: FRAMES,
      frameSeconds: FRAME_SECONDS,
      startSeconds: 0,
      firstChannel: 0,
      values,
      scales: Float64Array.from({ length: WIDTH }, (_, c) => (c < 3 ? 1 : RADIANS_PER_DEGREE)),
      interpolation,
    },
  };
}

const takes = Array.from({ length: CHARACTERS }, (_, i) => walk(i, 'linear'));
const compiled = compileSkeleton(skeleton);
/** As in the page: all matrices of all characters in one array. */
const worlds = new Float64Array(16 * JOINTS * CHARACTERS);
const worldOf = Array.from({ length: CHARACTERS }, (_, i) => worlds.subarray(16 * JOINTS * i, 16 * JOINTS * (i + 1)));

let tick = 0;
/** Just over two frames of samples per screen frame: never at a frame, never twice in the same one. */
const between = () => ((tick++ * 2.003 + 0.31) % (FRAMES - 2)) * FRAME_SECONDS;
const atFrames = () => ((tick++ * 2) % (FRAMES - 2)) * FRAME_SECONDS;

function crowd(interpolation: Interpolation): PosePlayer[] {
  return takes.map((take, i) => {
    const own = take.samples && { ...take, samples: { ...take.samples, interpolation } };
    return new PosePlayer(character({ id: `c${i}`, skeleton, takes: own ? [own] : [], shownTake: 0 }));
  });
}

function play(players: readonly PosePlayer[], time: number): void {
  for (let i = 0; i < CHARACTERS; i++) {
    players[i].seek(time);
    worldMatrices(compiled, players[i].dofs, worldOf[i], players[i].rotations);
  }
}

const { parent, offsets } = compiled;
const bare = {
  parent,
  offsets,
  frameSeconds: FRAME_SECONDS,
  values: takes.map((take) => take.samples?.values ?? new Float64Array(0)),
};
const bareSlerp = bareCrowd(bare, 'slerp');
const bareMix = bareCrowd(bare, 'mixed angles');

describe('50 characters of 70 joints, a frame between two of the samples', () => {
  for (const interpolation of INTERPOLATIONS) {
    const players = crowd(interpolation);
    bench(`ours, ${interpolation}`, () => play(players, between()));
  }
  bench('bare loop, slerp', () => bareSlerp(between()));
  bench('bare loop, angles mixed', () => bareMix(between()));
});

describe('50 characters of 70 joints, a frame at one of the samples', () => {
  const players = crowd('linear');
  bench('ours', () => play(players, atFrames()));
  bench('bare loop', () => bareMix(atFrames()));
});
