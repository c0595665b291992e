/** People whose y points down, as in pictures, stand upright wherever they go; their files keep their numbers. */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, expect, it } from 'vitest';
import { readNpz } from '../../dataset/read-npz.ts';
import { command } from '../../helpers/command.ts';
import { npyOf } from '../../helpers/numpy.ts';

const folder = mkdtempSync(join(tmpdir(), 'marrow-down-'));
afterAll(() => rmSync(folder, { recursive: true }));

/** Parts of a person who stands, and lifts an arm, in MediaPipe's order: left is +x, the face +z. */
type Places = Readonly<Record<string, readonly [x: number, y: number, z: number]>>;
const EYES: Places = { eye_inner: [0.02, 1.64, 0.1], eye: [0.03, 1.64, 0.1], eye_outer: [0.05, 1.64, 0.09] };
const PAIRS: Places = {
  ...{ ear: [0.08, 1.62, 0], mouth: [0.03, 1.55, 0.1], shoulder: [0.2, 1.42, 0], elbow: [0.25, 1.15, -0.02] },
  ...{ wrist: [0.27, 0.9, 0.05], pinky: [0.27, 0.82, 0.02], index: [0.27, 0.8, 0.07], thumb: [0.25, 0.84, 0.1] },
  ...{ hip: [0.1, 0.95, 0], knee: [0.11, 0.5, 0.03], ankle: [0.1, 0.08, 0], heel: [0.1, 0.02, -0.05] },
  foot_index: [0.12, 0.01, 0.15],
};
const PARTS: Places = { ...EYES, ...PAIRS };
const NAMES = [
  'nose',
  ...['left', 'right'].flatMap((side) => Object.keys(EYES).map((part) => `${side}_${part}`)),
  ...Object.keys(PAIRS).flatMap((part) =>
    part === 'mouth' ? ['mouth_left', 'mouth_right'] : [`left_${part}`, `right_${part}`],
  ),
];
const FRAMES = Array.from({ length: 5 }, (_, frame) =>
  NAMES.map((name) => {
    const [x, y, z] = PARTS[name.replace(/^(left|right)_|_(left|right)$/, '')] ?? [0, 1.6, 0.12];
    const lifted = /left_(wrist|pinky|index|thumb)/.test(name) ? 0.15 * frame : 0;
    return [name.includes('right') ? -x : x, y + lifted, z + 0.1 * frame];
  }),
);
const table = (sign: number) =>
  [
    `time,${NAMES.flatMap((name) => ['x', 'y', 'z'].map((axis) => `${name}.${axis}`)).join(',')}`,
    ...FRAMES.map((points, frame) => `${frame / 30},${points.map(([x, y, z]) => [x, sign * y, sign * z]).join(',')}`),
  ].join('\n');
writeFileSync(join(folder, 'up.csv'), table(1));
writeFileSync(join(folder, 'down.csv'), table(-1));
const array = Float32Array.from(FRAMES.flat().flatMap(([x, y, z]) => [x, -y, -z]));
writeFileSync(join(folder, 'down.npy'), npyOf([[FRAMES.length, NAMES.length, 3], array]));

/** Numbers of its joints in a frame: pelvis and neck are between others. */
const JOINTS = 3 * (33 + 2);

const run = async (...args: readonly string[]) => {
  const { code, err, out } = await command(args, folder);
  expect([code, code === 0 ? '' : err]).toEqual([0, '']);
  return { out, err };
};
/** Positions that `export` makes of a file, in metres with y up. */
async function exported(file: string, ...options: readonly string[]): Promise<readonly number[]> {
  const out = `${file}-${options.length}`;
  await run('export', file, '--to', 'npz', '--out', out, '--force', ...options);
  const { positions } = readNpz(readFileSync(join(folder, out, `${file.replace(/\.\w+$/, '')}.npz`)));
  return Array.from<number | string>(positions.values).map(Number);
}
const expectNear = (found: readonly number[], wanted: readonly number[], tolerance = 1e-5) => {
  expect(found.length).toBe(wanted.length);
  const off = found.map((value, i) => Math.abs(value - wanted[i]));
  expect(Math.max(...off)).toBeLessThan(tolerance);
};

it('tables and arrays say so, keep their numbers, and are exported upright', async () => {
  expect((await run('info', 'down.csv')).err).toContain('1 m per unit, y down');
  expect((await run('info', 'up.csv')).err).toContain('1 m per unit, y up');
  const { out } = await run('pose', 'down.csv', '--frame', '0', '--json');
  const [{ joints }] = JSON.parse(out).characters;
  const nose = joints.find(({ name }: { readonly name: string }) => name === 'nose');
  expect(nose.world.slice(12, 14)).toEqual([expect.closeTo(0), expect.closeTo(-1.6, 1)]);
  const upright = await exported('up.csv');
  expectNear(await exported('down.csv'), upright);
  expectNear(await exported('down.npy'), upright);
});

it.each(['glb', 'fbx', 'asf', 'npz'])('a .%s of it stands upright', async (to) => {
  const written = to === 'asf' ? 'amc' : to;
  if (to === 'npz') {
    await run('export', 'down.csv', '--to', 'npz', '--raw', '--out', '.');
    expectNear(await exported('down.npz'), await exported('up.csv'));
    return;
  }
  // Its reader turns the axes by a node above, of which there is none where they are ours.
  const joints = (list: readonly number[]) =>
    to === 'fbx' ? list.filter((_, i) => i % (list.length / 5) >= list.length / 5 - JOINTS) : list;
  await run('convert', 'up.csv', `up.${to}`);
  await run('convert', 'down.csv', `down.${to}`);
  expectNear(joints(await exported(`down.${written}`)), joints(await exported(`up.${written}`)), 2e-3);
});

it('a take of it is retargeted as the upright one', async () => {
  await run('convert', 'up.csv', 'hero.bvh');
  const options = ['--retarget', 'hero.bvh'];
  expectNear(await exported('down.csv', ...options), await exported('up.csv', ...options), 1e-4);
});

it('a review finds it on the ground', async () => {
  const list = async (file: string) => JSON.parse((await run('review', file, '--json')).out);
  const [up, down] = [await list('up.csv'), await list('down.csv')];
  expect(JSON.stringify(down).replaceAll('down', 'up')).toBe(JSON.stringify(up));
});
