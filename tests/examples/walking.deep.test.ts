/** Measures what makes a walk believable, from the written curves and the evaluator's matrices. */
import { describe, expect, it } from 'vitest';
import { CRAWL_PATH, LIFTS } from '../../examples/characters/crawler/gait.ts';
import { LEGS, TIBIA } from '../../examples/characters/crawler/skeleton.ts';
import type { Sample } from '../../examples/characters/example.ts';
import { makeSamples } from '../../examples/characters/examples.ts';
import { pathSeconds } from '../../examples/characters/motion/path.ts';
import { jointIndex, posedFrames } from '../../examples/characters/shape/skeletons.ts';
import { FLAT_FROM, HEEL_LIFTS, TOE_LEAVES, WALK_PATH } from '../../examples/characters/walker/gait.ts';
import { ANKLE_HEIGHT, HEEL_CONTACT, TOE_OFFSET } from '../../examples/characters/walker/skeleton.ts';
import { compileTake } from '../../src/evaluate/compiled-take.ts';
import { evaluateTake } from '../../src/evaluate/curves.ts';
import { clampDofs, compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import type { Vec3 } from '../../src/math/vec3.ts';
import { firstDofs } from '../../src/model/skeleton/dofs.ts';
import type { Skin } from '../../src/model/skin.ts';

const samples = makeSamples();
const walker = find('walker');
const crawler = find('crawler');

function find(id: string): Sample {
  const sample = samples.find((s) => s.id === id);
  if (!sample) throw new Error(`no sample ${id}`);
  return sample;
}

/** Poses an example as in playback: curves, limits, matrices. */
function player({ skeleton, take, morphs }: Sample) {
  const compiled = compileSkeleton(skeleton);
  const curves = compileTake(take);
  const first = firstDofs(skeleton);
  const dofs = new Float64Array(3 + 3 * skeleton.joints.length + morphs.length);
  const world = new Float64Array(16 * skeleton.joints.length);
  return {
    dofs,
    dofOf: (joint: string, axis: number) => first[jointIndex(skeleton, joint)] + axis,
    seek(seconds: number) {
      evaluateTake(curves, seconds, dofs);
      clampDofs(compiled, dofs);
      worldMatrices(compiled, dofs, world);
    },
    point(joint: string, [x, y, z]: Vec3): Vec3 {
      const o = 16 * jointIndex(skeleton, joint);
      const row = (r: number) => world[o + r] * x + world[o + 4 + r] * y + world[o + 8 + r] * z + world[o + 12 + r];
      return [row(0), row(1), row(2)];
    },
    world,
  };
}

const heightOf = ({ skin }: Sample) => {
  const heights = [...(skin?.positions ?? [])].filter((_, i) => i % 3 === 1);
  return heights.reduce((a, b) => Math.max(a, b)) - heights.reduce((a, b) => Math.min(a, b));
};

const level = (a: Vec3, b: Vec3) => Math.hypot(a[0] - b[0], a[2] - b[2]);

/** The largest horizontal distance of a point from its position at the first of these times. */
function slip(times: readonly number[], at: (seconds: number) => Vec3): number {
  const start = at(times[0]);
  return times.reduce((worst, t) => Math.max(worst, level(at(t), start)), 0);
}

const between = (from: number, to: number) => Array.from({ length: 60 }, (_, i) => from + ((to - from) * i) / 59);

describe('the walker', () => {
  const play = player(walker);
  const height = heightOf(walker);
  const stride = WALK_PATH.strideSeconds;
  const feet = [
    ['_l', 0],
    ['_r', 0.5],
  ] as const;

  it('the walker has at least 20 joints, 2,000 vertices and three morphs', () => {
    expect(walker.skeleton.joints.length).toBeGreaterThanOrEqual(20);
    expect((walker.skin?.positions.length ?? 0) / 3).toBeGreaterThanOrEqual(2000);
    expect(walker.morphs.length).toBeGreaterThanOrEqual(3);
  });

  it('blends its weights: most joints share vertices with another one', () => {
    const { start, joints } = walker.skin?.attachments ?? { start: [], joints: [] };
    const sharing = new Set<number>();
    for (let v = 0; v + 1 < start.length; v++) {
      if (start[v + 1] - start[v] > 1) for (let a = start[v]; a < start[v + 1]; a++) sharing.add(joints[a]);
    }
    expect(sharing.size).toBeGreaterThanOrEqual(20);
  });

  it('drives every morph through most of its range', () => {
    const first = walker.take.channels.length - walker.morphs.length;
    const extremes = walker.morphs.map(() => [1, 0]);
    for (const t of between(0, pathSeconds(WALK_PATH)).flatMap((t) => between(t, t + 0.1))) {
      play.seek(t);
      extremes.forEach((e, m) => {
        e[0] = Math.min(e[0], play.dofs[first + m]);
        e[1] = Math.max(e[1], play.dofs[first + m]);
      });
    }
    for (const [low, high] of extremes) {
      expect(low).toBeLessThan(0.2);
      expect(high).toBeGreaterThan(0.9);
    }
  });

  it.each(feet)('foot %s slips less than 0.25 % of the height while it is planted, in every stride', (suffix, lag) => {
    const heel = (t: number) => {
      play.seek(t);
      return play.point(`foot${suffix}`, HEEL_CONTACT);
    };
    const ball = (t: number) => {
      play.seek(t);
      return play.point(`toe${suffix}`, [0, -ANKLE_HEIGHT - TOE_OFFSET[1], 0]);
    };
    for (let k = 0; k < WALK_PATH.strides; k++) {
      const at = (phase: number) => (k + lag + phase) * stride;
      expect(slip(between(at(0), at(HEEL_LIFTS)), heel)).toBeLessThan(0.0025 * height);
      expect(slip(between(at(FLAT_FROM), at(TOE_LEAVES)), ball)).toBeLessThan(0.0025 * height);
      // Both are on the ground meanwhile.
      for (const t of between(at(0), at(HEEL_LIFTS))) expect(Math.abs(heel(t)[1])).toBeLessThan(0.001 * height);
      for (const t of between(at(FLAT_FROM), at(TOE_LEAVES))) expect(Math.abs(ball(t)[1])).toBeLessThan(0.001 * height);
    }
  });

  it('no vertex of the walker slides over the ground, or is below it', () => {
    const { skin } = walker;
    if (!skin) throw new Error('no skin');
    const near = [...Array(skin.positions.length / 3).keys()].filter((v) => skin.positions[3 * v + 1] < 0.2);
    const rest = posedFrames(walker.skeleton);
    const place = skinner(skin, rest, play.world);
    const frame = 1 / 120;
    const wrong: string[] = [];
    let before: Vec3[] | undefined;
    for (let t = 0; t < 2 * stride; t += frame) {
      play.seek(t);
      const now = near.map(place);
      now.forEach((p, i) => {
        if (!(p[1] > -0.0015 * height)) wrong.push(`vertex ${near[i]} is at a height of ${p[1]} at ${t} s`);
        // Below half a percent of the height in two successive frames: it is planted.
        const low = 0.005 * height;
        if (!before || !(p[1] < low && before[i][1] < low)) return;
        const slid = level(p, before[i]);
        if (!(slid < 0.001 * height)) wrong.push(`vertex ${near[i]} slides by ${slid} at ${t} s`);
      });
      before = now;
    }
    expect(wrong).toEqual([]);
  });

  it('lifts its feet clear of the ground in mid-swing', () => {
    for (const [suffix, lag] of feet) {
      play.seek((lag + (TOE_LEAVES + 1) / 2) * stride);
      expect(play.point(`toe${suffix}`, [0, -0.03, 0.1])[1]).toBeGreaterThan(0.02 * height);
    }
  });

  it('the walker has knees that never straighten fully nor jump', () => {
    const rates: number[] = [];
    const step = 0.005;
    for (const suffix of ['_l', '_r']) {
      const knee = play.dofOf(`shin${suffix}`, 0);
      let last: number | undefined;
      for (let t = 0; t < stride; t += step) {
        play.seek(t);
        expect(play.dofs[knee]).toBeGreaterThan(0.15);
        if (last !== undefined) rates.push(Math.abs(play.dofs[knee] - last) / step);
        last = play.dofs[knee];
      }
    }
    // 20 rad/s: a third of a sprinter's knee.
    expect(rates.reduce((a, b) => Math.max(a, b))).toBeLessThan(20);
  });

  it('swings each arm with the opposite leg, and keeps its head stiller than its chest', () => {
    let agreement = 0;
    const turns: Record<'head' | 'chest', number[]> = { head: [], chest: [] };
    for (const t of between(0, stride)) {
      play.seek(t);
      const heading = WALK_PATH.heading(t);
      const ahead = (joint: string) => {
        const p = play.point(joint, [0, 0, 0]);
        return p[0] * Math.sin(heading) + p[2] * Math.cos(heading);
      };
      agreement += (ahead('hand_l') - ahead('hand_r')) * (ahead('foot_l') - ahead('foot_r'));
      for (const joint of ['head', 'chest'] as const) {
        const [o, f] = [play.point(joint, [0, 0, 0]), play.point(joint, [0, 0, 1])];
        turns[joint].push(Math.atan2(f[0] - o[0], f[2] - o[2]) - heading);
      }
    }
    expect(agreement).toBeLessThan(0);
    const range = (xs: number[]) => Math.max(...xs) - Math.min(...xs);
    expect(range(turns.head)).toBeLessThan(0.4 * range(turns.chest));
  });
});

describe('the crawler', () => {
  const play = player(crawler);
  const height = heightOf(crawler);
  const stride = CRAWL_PATH.strideSeconds;

  it.each(LEGS.map((leg) => [leg.name, leg] as const))('leg %s slips less than 1 % of the height', (name, leg) => {
    const tip = (t: number) => {
      play.seek(t);
      return play.point(`tibia_${name}`, [leg.side * TIBIA, 0, 0]);
    };
    for (let k = 0; k < CRAWL_PATH.strides; k++) {
      const times = between((k + leg.lag) * stride, (k + leg.lag + LIFTS) * stride);
      expect(slip(times, tip)).toBeLessThan(0.01 * height);
      for (const t of times) expect(Math.abs(tip(t)[1])).toBeLessThan(0.01 * height);
    }
  });

  it('the crawler has at least three feet planted at any time', () => {
    for (const t of between(0, stride)) {
      const standing = LEGS.filter((leg) => (t / stride + 1 - leg.lag) % 1 < LIFTS);
      expect(standing.length).toBeGreaterThanOrEqual(3);
    }
  });
});

describe.each([walker, crawler].map((s) => [s.id, s] as const))('%s, played in a loop', (id, sample) => {
  it('ends as it began, but for the way that it came', () => {
    const play = player(sample);
    const [from, to] = sample.take.range;
    play.seek(from);
    const first = play.world.slice();
    play.seek(to);
    const way = id === 'walker' ? 7 : 0;
    play.world.forEach((x, i) => {
      expect(Math.abs(x - first[i] - (i % 16 === 14 ? way : 0))).toBeLessThan(2e-3);
    });
  });

  it('stays on its way: the walker on its line, the crawler on its circle', () => {
    const play = player(sample);
    for (const t of between(...sample.take.range)) {
      play.seek(t);
      const [x, y, z] = play.point('root', [0, 0, 0]);
      const off = id === 'walker' ? level([x, y, 0], [0, 0, 0]) : level([x, y, z], [0, 0, 0]) - 1;
      expect(Math.abs(off)).toBeLessThan(0.1 * heightOf(sample));
    }
  });
});

/** Position of a vertex: Σ w · W · B⁻¹ · v, written out for bindings that are rotations. */
function skinner(skin: Skin, rest: ReturnType<typeof posedFrames>, world: Float64Array) {
  const { start, joints, weights } = skin.attachments ?? { start: [], joints: [], weights: [] };
  return (v: number): Vec3 => {
    const sum: [number, number, number] = [0, 0, 0];
    for (let a = start[v]; a < start[v + 1]; a++) {
      const { turn: m, at } = rest[joints[a]];
      const d = [0, 1, 2].map((i) => skin.positions[3 * v + i] - at[i]);
      const local = [0, 1, 2].map((c) => m[c] * d[0] + m[3 + c] * d[1] + m[6 + c] * d[2]);
      const o = 16 * joints[a];
      for (let r = 0; r < 3; r++) {
        const along = world[o + r] * local[0] + world[o + 4 + r] * local[1] + world[o + 8 + r] * local[2];
        sum[r] += weights[a] * (along + world[o + 12 + r]);
      }
    }
    return sum;
  };
}
