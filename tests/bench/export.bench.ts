/**
 * The arrays of a take of 1,000 frames and 25 joints, as `marrow export` writes them, against a bare loop that makes of
 * the same angles only the local and world quaternions and the positions, joint by joint with `Math.sin` and
 * `Math.cos`: no signs, 6D, velocities, contacts, units, or other joints. Goal: at most its time. With the review's
 * checks in passing it is some twice as long.
 */
import { afterAll, bench, describe } from 'vitest';
import { checkOf } from '../../src/cli/export/take-check.ts';
import { FloatPool } from '../../src/dataset/float-pool.ts';
import { takeOf } from '../../src/dataset/take.ts';
import { takeArrays } from '../../src/dataset/take-arrays.ts';
import { capturedContent } from '../../src/files/captured.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import { readBvh } from '../../src/formats/bvh/read.ts';
import { EMPTY_DOCUMENT } from '../../src/model/document.ts';

const JOINTS = 25;
const FRAMES = 1000;
/** Five chains of five joints, of which the first is the root's. */
const parentOf = (j: number) => (j % 5 === 0 ? (j === 0 ? -1 : 0) : j - 1);

function takeText(): string {
  const children = (parent: number) =>
    Array.from({ length: JOINTS }, (_, j) => j).filter((j) => parentOf(j) === parent);
  const tree = (j: number): string => {
    const channels =
      j === 0 ? '6 Xposition Yposition Zposition Zrotation Xrotation Yrotation' : '3 Zrotation Xrotation Yrotation';
    const below = children(j).map(tree).join(' ') || 'End Site { OFFSET 0 5 0 }';
    return `${j === 0 ? 'ROOT' : 'JOINT'} j${j} { OFFSET ${j % 3} 20 ${j % 4} CHANNELS ${channels} ${below} }`;
  };
  const rows = Array.from({ length: FRAMES }, (_, f) =>
    Array.from({ length: 3 + 3 * JOINTS }, (_, d) => (60 * Math.sin(f / 40 + d)).toFixed(4)).join(' '),
  );
  return `HIERARCHY ${tree(0)}\nMOTION\nFrames: ${FRAMES}\nFrame Time: 0.01\n${rows.join('\n')}\n`;
}

const { value = [] } = readBvh(takeText(), 'take.bvh');
const source = { name: 'take.bvh', path: 'take.bvh', bytes: 0 };
const opened = openFiles(EMPTY_DOCUMENT, [{ ...capturedContent(value, 'take.bvh').value, source }]);
const [character] = opened.document.characters;
const samples = character.takes[0].samples;
if (!samples) throw new Error('The take has no samples.');

const pool = new FloatPool('float32');
const bare = {
  local: new Float32Array(4 * JOINTS * FRAMES),
  world: new Float32Array(4 * JOINTS * FRAMES),
  positions: new Float32Array(3 * JOINTS * FRAMES),
};
const parents = Int32Array.from({ length: JOINTS }, (_, j) => parentOf(j));
const offsets = Float64Array.from(character.skeleton?.joints.flatMap(({ offset }) => [...offset]) ?? []);
const { values, scales } = samples;

function bareArrays(): void {
  const { local, world, positions } = bare;
  for (let f = 0; f < FRAMES; f++) {
    for (let j = 0; j < JOINTS; j++) {
      const at = f * scales.length + 3 + 3 * j;
      const z = (values[at] * scales[3]) / 2;
      const x = (values[at + 1] * scales[3]) / 2;
      const y = (values[at + 2] * scales[3]) / 2;
      const [sx, cx, sy, cy, sz, cz] = [Math.sin(x), Math.cos(x), Math.sin(y), Math.cos(y), Math.sin(z), Math.cos(z)];
      const bx = sx * cy * cz - cx * sy * sz;
      const by = cx * sy * cz + sx * cy * sz;
      const bz = cx * cy * sz + sx * sy * cz;
      const bw = cx * cy * cz - sx * sy * sz;
      const q = 4 * (f * JOINTS + j);
      const p = 3 * (f * JOINTS + j);
      local[q] = bx;
      local[q + 1] = by;
      local[q + 2] = bz;
      local[q + 3] = bw;
      const isRoot = parents[j] < 0;
      const a = 4 * (f * JOINTS + parents[j]);
      const from = 3 * (f * JOINTS + parents[j]);
      const [ax, ay, az, aw] = isRoot ? [0, 0, 0, 1] : [world[a], world[a + 1], world[a + 2], world[a + 3]];
      world[q] = aw * bx + ax * bw + ay * bz - az * by;
      world[q + 1] = aw * by - ax * bz + ay * bw + az * bx;
      world[q + 2] = aw * bz + ax * by - ay * bx + az * bw;
      world[q + 3] = aw * bw - ax * bx - ay * by - az * bz;
      const [vx, vy, vz] = [offsets[3 * j], offsets[3 * j + 1], offsets[3 * j + 2]];
      const ux = ay * vz - az * vy + aw * vx;
      const uy = az * vx - ax * vz + aw * vy;
      const uz = ax * vy - ay * vx + aw * vz;
      positions[p] = (isRoot ? 0 : positions[from]) + vx + 2 * (ay * uz - az * uy);
      positions[p + 1] = (isRoot ? 0 : positions[from + 1]) + vy + 2 * (az * ux - ax * uz);
      positions[p + 2] = (isRoot ? 0 : positions[from + 2]) + vz + 2 * (ax * uy - ay * ux);
    }
  }
}

const best = new Map<string, number>();
function timed(name: string, run: () => void): void {
  bench(
    name,
    () => {
      const start = performance.now();
      run();
      best.set(name, Math.min(best.get(name) ?? Infinity, performance.now() - start));
    },
    { time: 2000 },
  );
}

describe('the arrays of a take of 1,000 frames and 25 joints', () => {
  timed('bare loop', bareArrays);
  timed('ours', () => void takeArrays(takeOf(character, {}), pool));
  timed('ours, with checks', () => {
    const take = takeOf(character, {});
    const check = checkOf(take, character);
    takeArrays(take, pool, check);
    check?.end();
  });
});

afterAll(() => {
  const bareTime = best.get('bare loop') ?? Number.NaN;
  for (const [name, time] of best) {
    console.log(
      `${name.padEnd(20)} ${time.toFixed(2)} ms   ${(time / bareTime).toFixed(2)} times the bare loop's time`,
    );
  }
});
