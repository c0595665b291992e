/**
 * A frame of 100 characters of 25 joints: channels, limits, local and world matrices, W·B⁻¹ for the skin. Against a
 * bare loop with the same arithmetic (a search and a cubic per channel, six sines and cosines per joint, two products
 * of affine matrices) without look-ups. Goal, including bone textures: at most 3 times that.
 */
import { bench, describe } from 'vitest';
import { compileTake } from '../../src/evaluate/compiled-take.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { compileSkin, skinMatrices } from '../../src/evaluate/skin/deform.ts';
import type { Take } from '../../src/model/takes/take.ts';
import { SMOOTH } from '../../src/model/takes/tangent-kinds.ts';
import { character, joint, skin } from '../helpers/builders.ts';

const CHARACTERS = 100;
const JOINTS = 25;
const KEYS = 30;
const SECONDS = 2;
const CHANNELS = 3 + 3 * JOINTS;

const tangents = { kinds: new Uint8Array(KEYS).fill(SMOOTH), slopes: new Float64Array(KEYS) };
const walk: Take = {
  name: 'walk',
  range: [0, SECONDS],
  channels: Array.from({ length: CHANNELS }, (_, c) => ({
    kind: 'keys',
    extrapolateIn: 'cycle',
    extrapolateOut: 'cycle',
    times: Float64Array.from({ length: KEYS }, (_, k) => (k * SECONDS) / (KEYS - 1)),
    values: Float64Array.from({ length: KEYS }, (_, k) => Math.sin(c + k)),
    tangentsIn: tangents,
    tangentsOut: tangents,
  })),
};
const limit = { min: -0.8, max: 0.9 };
const skeleton = {
  name: 'hero',
  joints: Array.from({ length: JOINTS }, (_, j) => joint(Math.floor((j - 1) / 2), { limits: [limit, limit, limit] })),
};
const hero = character({ skeleton, takes: [walk], shownTake: 0 });
/** Each slightly later than the previous one. */
const crowd = Array.from({ length: CHARACTERS }, (_, i) => ({ ...hero, id: `c${i}`, timeOffsetSeconds: i / 100 }));
const compiledSkin = compileSkin(skin('hero', JOINTS - 1));
const compiledSkeleton = compileSkeleton(skeleton);
const pose = new Float64Array(dofCountOf(hero));
const world = new Float64Array(16 * JOINTS);
const palette = new Float64Array(16 * JOINTS * CHARACTERS);
const palettes = crowd.map((_, i) => palette.subarray(16 * JOINTS * i, 16 * JOINTS * (i + 1)));

let frame = 0;
const now = () => ((frame++ % 60) / 60) * (SECONDS - 1);

describe('100 characters of 25 joints, a frame', () => {
  bench('ours', () => {
    const time = now();
    for (let i = 0; i < CHARACTERS; i++) {
      poseAt(crowd[i], time, pose);
      worldMatrices(compiledSkeleton, pose, world);
      skinMatrices(compiledSkin, world, palettes[i]);
    }
  });

  const { times, cubics } = compileTake(walk);
  const { parent, offsets, lower, upper } = compiledSkeleton;
  const { inverseBindings } = compiledSkin;

  bench('bare loop', () => {
    const time = now();
    for (let i = 0; i < CHARACTERS; i++) bareCharacter(time + i / 100, 16 * JOINTS * i);
  });

  function bareCharacter(t: number, out: number): void {
    for (let c = 0; c < CHANNELS; c++) {
      let low = KEYS * c;
      let high = low + KEYS - 1;
      while (high - low > 1) {
        const middle = (low + high) >>> 1;
        if (times[middle] <= t) low = middle;
        else high = middle;
      }
      const d = t - times[low];
      const o = 4 * low;
      const value = ((cubics[o + 3] * d + cubics[o + 2]) * d + cubics[o + 1]) * d + cubics[o];
      pose[c] = c < 3 ? value : Math.min(upper[c - 3], Math.max(lower[c - 3], value));
    }
    for (let j = 0; j < JOINTS; j++) {
      const sx = Math.sin(pose[3 + 3 * j]);
      const cx = Math.cos(pose[3 + 3 * j]);
      const sy = Math.sin(pose[4 + 3 * j]);
      const cy = Math.cos(pose[4 + 3 * j]);
      const sz = Math.sin(pose[5 + 3 * j]);
      const cz = Math.cos(pose[5 + 3 * j]);
      bareLocal[0] = cy * cz;
      bareLocal[1] = cy * sz;
      bareLocal[2] = -sy;
      bareLocal[4] = sx * sy * cz - cx * sz;
      bareLocal[5] = sx * sy * sz + cx * cz;
      bareLocal[6] = sx * cy;
      bareLocal[8] = cx * sy * cz + sx * sz;
      bareLocal[9] = cx * sy * sz - sx * cz;
      bareLocal[10] = cx * cy;
      bareLocal[12] = offsets[3 * j];
      bareLocal[13] = offsets[3 * j + 1];
      bareLocal[14] = offsets[3 * j + 2];
      const p = parent[j];
      if (p < 0) {
        for (let k = 0; k < 3; k++) bareLocal[12 + k] += pose[k];
        world.set(bareLocal, 0);
      } else bareProduct(world, 16 * p, bareLocal, 0, world, 16 * j);
      bareProduct(world, 16 * j, inverseBindings, 16 * j, palette, out + 16 * j);
    }
  }
});

const bareLocal = new Float64Array(16);
bareLocal[15] = 1;

function bareProduct(a: Float64Array, p: number, b: Float64Array, q: number, out: Float64Array, o: number): void {
  for (let c = 0; c < 4; c++) {
    for (let r = 0; r < 3; r++) {
      out[o + 4 * c + r] = a[p + r] * b[q + 4 * c] + a[p + 4 + r] * b[q + 4 * c + 1] + a[p + 8 + r] * b[q + 4 * c + 2];
    }
    out[o + 4 * c + 3] = c === 3 ? 1 : 0;
  }
  out[o + 12] += a[p + 12];
  out[o + 13] += a[p + 13];
  out[o + 14] += a[p + 14];
}
