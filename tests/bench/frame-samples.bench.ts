/**
 * A frame of 50 characters of 70 joints that follow 1,000 frames of samples each, as the page plays them: sampled
 * through the mixer into DOFs, matrices of DOFs. Against bare loops over the same typed arrays, with nothing to look up:
 * one does the same (six half angles' sines and cosines a frame and joint, slerp, matrix of the quaternion, product of
 * affine matrices), the other mixes the angles as if they were lengths, which is wrong, but the least there is to do.
 * To hold: within 3× of the first.
 */
import { bench, describe } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { type ChannelClip, keylessChannel } from '../../src/model/clip.ts';
import { INTERPOLATIONS, type Interpolation, RADIANS_PER_DEGREE } from '../../src/model/samples.ts';
import type { Joint } from '../../src/model/skeleton.ts';
import { PosePlayer } from '../../src/view/pose-track.ts';
import { character, joint } from '../helpers/builders.ts';

const CHARACTERS = 50;
const JOINTS = 70;
const FRAMES = 1000;
const FRAME_SECONDS = 1 / 120;
const WIDTH = 3 + 3 * JOINTS;

/** Numbers that look random, the same in every run. */
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

/** Degrees that wander, up to 2° a frame. */
function walk(seed: number, interpolation: Interpolation): ChannelClip {
  const random = noise(seed);
  const values = new Float64Array(WIDTH * FRAMES);
  for (let i = 0; i < values.length; i++) {
    values[i] = (i < WIDTH ? 0 : values[i - WIDTH]) + 4 * random.next().value - 2;
  }
  return {
    name: 'walk',
    range: [0, (FRAMES - 1) * FRAME_SECONDS],
    channels: Array.from({ length: WIDTH }, () => keylessChannel()),
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

const clips = Array.from({ length: CHARACTERS }, (_, i) => walk(i, 'linear'));
const { parent, offsets } = compileSkeleton(skeleton);
const compiled = compileSkeleton(skeleton);
/** As the page holds them: all matrices of all characters in one array. */
const worlds = new Float64Array(16 * JOINTS * CHARACTERS);
const worldOf = Array.from({ length: CHARACTERS }, (_, i) => worlds.subarray(16 * JOINTS * i, 16 * JOINTS * (i + 1)));

let tick = 0;
/** Two frames of samples in one of the screen, and a bit: never at a frame, never in the same one twice. */
const between = () => ((tick++ * 2.003 + 0.31) % (FRAMES - 2)) * FRAME_SECONDS;
const atFrames = () => ((tick++ * 2) % (FRAMES - 2)) * FRAME_SECONDS;

function crowd(interpolation: Interpolation): PosePlayer[] {
  return clips.map((clip, i) => {
    const own = clip.samples && { ...clip, samples: { ...clip.samples, interpolation } };
    return new PosePlayer(character({ id: `c${i}`, skeleton, clips: own ? [own] : [], shownClip: 0 }));
  });
}

function play(players: readonly PosePlayer[], time: number): void {
  for (let i = 0; i < CHARACTERS; i++) {
    players[i].seek(time);
    worldMatrices(compiled, players[i].dofs, worldOf[i]);
  }
}

describe('50 characters of 70 joints, a frame between two of the samples', () => {
  for (const interpolation of INTERPOLATIONS) {
    const players = crowd(interpolation);
    bench(`ours, ${interpolation}`, () => play(players, between()));
  }
  bench('bare loop, slerp', () => {
    const time = between();
    for (let i = 0; i < CHARACTERS; i++) bareCharacter(i, time, bareSlerp);
  });
  bench('bare loop, angles mixed', () => {
    const time = between();
    for (let i = 0; i < CHARACTERS; i++) bareCharacter(i, time, bareMix);
  });
});

describe('50 characters of 70 joints, a frame at one of the samples', () => {
  const players = crowd('linear');
  bench('ours', () => play(players, atFrames()));
  bench('bare loop', () => {
    const time = atFrames();
    for (let i = 0; i < CHARACTERS; i++) bareCharacter(i, time, bareMix);
  });
});

const values = clips.map((clip) => clip.samples?.values ?? new Float64Array(0));
const local = new Float64Array(16);
local[15] = 1;

function bareCharacter(i: number, time: number, turn: (v: Float64Array, at: number, u: number) => void): void {
  const v = values[i];
  const f = time / FRAME_SECONDS;
  const row = Math.floor(f);
  const u = f - row;
  const at = row * WIDTH;
  const base = 16 * JOINTS * i;
  for (let j = 0; j < JOINTS; j++) {
    turn(v, at + 3 + 3 * j, u);
    for (let k = 0; k < 3; k++) {
      local[12 + k] = j === 0 ? v[at + k] + (v[at + WIDTH + k] - v[at + k]) * u : offsets[3 * j + k];
    }
    if (j === 0) worlds.set(local, base);
    else bareProduct(base + 16 * parent[j], base + 16 * j);
  }
}

const from = new Float64Array(4);
const to = new Float64Array(4);

/** Rz·Rx·Ry of degrees, as a quaternion x y z w. */
function bareQuaternion(v: Float64Array, at: number, out: Float64Array): void {
  const half = RADIANS_PER_DEGREE / 2;
  const sz = Math.sin(v[at] * half);
  const cz = Math.cos(v[at] * half);
  const sx = Math.sin(v[at + 1] * half);
  const cx = Math.cos(v[at + 1] * half);
  const sy = Math.sin(v[at + 2] * half);
  const cy = Math.cos(v[at + 2] * half);
  out[0] = cz * sx * cy - sz * cx * sy;
  out[1] = cz * cx * sy + sz * sx * cy;
  out[2] = sz * cx * cy + cz * sx * sy;
  out[3] = cz * cx * cy - sz * sx * sy;
}

function bareSlerp(v: Float64Array, at: number, u: number): void {
  bareQuaternion(v, at, from);
  bareQuaternion(v, at + WIDTH, to);
  let cosine = from[0] * to[0] + from[1] * to[1] + from[2] * to[2] + from[3] * to[3];
  const sign = cosine < 0 ? -1 : 1;
  cosine *= sign;
  const theta = Math.acos(Math.min(1, cosine));
  const sine = Math.sin(theta);
  const p = sine > 1e-9 ? Math.sin((1 - u) * theta) / sine : 1 - u;
  const q = sign * (sine > 1e-9 ? Math.sin(u * theta) / sine : u);
  const x = p * from[0] + q * to[0];
  const y = p * from[1] + q * to[1];
  const z = p * from[2] + q * to[2];
  const w = p * from[3] + q * to[3];
  local[0] = 1 - 2 * (y * y + z * z);
  local[1] = 2 * (x * y + w * z);
  local[2] = 2 * (x * z - w * y);
  local[4] = 2 * (x * y - w * z);
  local[5] = 1 - 2 * (x * x + z * z);
  local[6] = 2 * (y * z + w * x);
  local[8] = 2 * (x * z + w * y);
  local[9] = 2 * (y * z - w * x);
  local[10] = 1 - 2 * (x * x + y * y);
}

function bareMix(v: Float64Array, at: number, u: number): void {
  const z = (v[at] + (v[at + WIDTH] - v[at]) * u) * RADIANS_PER_DEGREE;
  const x = (v[at + 1] + (v[at + WIDTH + 1] - v[at + 1]) * u) * RADIANS_PER_DEGREE;
  const y = (v[at + 2] + (v[at + WIDTH + 2] - v[at + 2]) * u) * RADIANS_PER_DEGREE;
  const sz = Math.sin(z);
  const cz = Math.cos(z);
  const sx = Math.sin(x);
  const cx = Math.cos(x);
  const sy = Math.sin(y);
  const cy = Math.cos(y);
  local[0] = cz * cy - sz * sx * sy;
  local[1] = sz * cy + cz * sx * sy;
  local[2] = -cx * sy;
  local[4] = -sz * cx;
  local[5] = cz * cx;
  local[6] = sx;
  local[8] = cz * sy + sz * sx * cy;
  local[9] = sz * sy - cz * sx * cy;
  local[10] = cx * cy;
}

function bareProduct(p: number, o: number): void {
  const a = worlds;
  for (let c = 0; c < 4; c++) {
    for (let r = 0; r < 3; r++) {
      a[o + 4 * c + r] = a[p + r] * local[4 * c] + a[p + 4 + r] * local[4 * c + 1] + a[p + 8 + r] * local[4 * c + 2];
    }
    a[o + 4 * c + 3] = c === 3 ? 1 : 0;
  }
  a[o + 12] += a[p + 12];
  a[o + 13] += a[p + 13];
  a[o + 14] += a[p + 14];
}
