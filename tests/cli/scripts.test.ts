/** What scripts rely on: paths, several times, matrices and slopes as JSON, an exit code for each outcome. */
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { COMMANDS } from '../../src/cli/run.ts';
import { command, commandJson, type InfoJson, type PoseJson } from '../helpers/command.ts';

const SKEL = 'balljoint root { offset 1 0 0 pose 0 0 0.5\n balljoint arm { offset 0 2 0 pose 0.25 0 0 } }\n';
const SKIN = `positions 1 { 0 3 0 }
normals 1 { 0 0 1 }
skinweights 1 { 1 1 1 }
triangles 0 { }
bindings 2 { matrix { 1 0 0 0 1 0 0 0 1 1 0 0 } matrix { 1 0 0 0 1 0 0 0 1 1 2 0 } }
`;
const ANIM = `animation { range 0 2 numchannels 9 ${'channel { extrapolate constant constant keys 0 { } } '.repeat(5)}
channel { extrapolate constant linear keys 3 { 0 0 flat flat 1 3 smooth linear 2 1 linear linear } }
${'channel { extrapolate constant constant keys 0 { } } '.repeat(3)} }
`;

let folder = '';
const write = (name: string, text: string) => {
  mkdirSync(dirname(join(folder, name)), { recursive: true });
  writeFileSync(join(folder, name), text);
};
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-'));
  for (const student of ['ann', 'bob']) {
    write(`class/${student}/test.skel`, SKEL);
    write(`class/${student}/test.anim`, ANIM);
  }
  write('class/cid/test.skel', 'balljoint root { offset 1 x 0 }\n');
  write('class/cid/test.anim', ANIM);
  write('a.skel', SKEL);
  write('a.skin', SKIN);
  write('a.anim', ANIM);
  write('turn.bvh', BVH);
  write('arm.axskel', '1 0 0 1 30 1\n2 1 0 0 -20 0\n');
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const BVH = `HIERARCHY
ROOT hip { OFFSET 0 1 0 CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
JOINT knee { OFFSET 0 -1 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 -1 0 } } }
MOTION
Frames: 2
Frame Time: 0.5
0 1 0 10 20 30 5 6 7
0 2 0 15 25 35 5 6 8
`;

describe('paths', () => {
  it('name files of a class apart in tables, JSON and problems', async () => {
    const text = await command(['info', 'class'], folder);
    expect(text.code).toBe(1);
    for (const student of ['ann', 'bob', 'cid']) expect(text.out).toContain(`class/${student}/test.anim  `);
    expect(text.err).toContain('class/cid/test.skel:1:27 error not-a-number');
    expect(text.err).toContain('class/cid/test.anim info held-back: Not opened. It belongs with class/cid/test.skel');
    const { files, diagnostics } = await commandJson<InfoJson>(['info', 'class'], folder, 1);
    expect(files.map(({ name }) => name)).toContain('class/bob/test.skel');
    expect(diagnostics.every(({ file }) => file.startsWith('class/cid/'))).toBe(true);
  });

  it('name a missing file as it was given', async () => {
    expect((await command(['info', 'class/dan/test.skel'], folder)).err).toContain('class/dan/test.skel error');
  });
});

describe('marrow pose --json', () => {
  it('has local matrices and W·B⁻¹ of each joint', async () => {
    const { characters } = await commandJson<PoseJson>(['pose', 'a.skel', 'a.skin'], folder);
    const [root, arm] = characters[0].joints;
    expect(root.local).toEqual(root.world);
    expect(arm.local?.slice(12, 15)).toEqual([0, 2, 0]);
    // Of a binding without a rotation: the same rotation, and back by its position.
    expect(arm.skinning?.slice(0, 11)).toEqual(arm.world.slice(0, 11));
    const back = [0, 1, 2].map((k) => arm.world[12 + k] - arm.world[k] - 2 * arm.world[4 + k]);
    back.forEach((value, k) => void expect(arm.skinning?.[12 + k]).toBeCloseTo(value, 12));
    const bare = await commandJson<PoseJson>(['pose', 'a.skel'], folder);
    expect(bare.characters[0].joints[1].skinning).toBeUndefined();
  });

  it('has a frame for each of --times, which equals that of --time', async () => {
    type Frames = { readonly frames: readonly (PoseJson & { readonly time: number })[] };
    const files = ['a.skel', 'a.skin', 'a.anim'];
    const { frames } = await commandJson<Frames>(['pose', ...files, '--times', '0.5,-1,0.5'], folder);
    expect(frames.map(({ time }) => time)).toEqual([0.5, -1, 0.5]);
    for (const { time, characters } of frames) {
      const one = await commandJson<PoseJson>(['pose', ...files, `--time=${time}`], folder);
      expect(characters).toEqual(one.characters);
    }
    const { out } = await command(['pose', ...files, '--times', '0.5,-1'], folder);
    expect(out.match(/^time .*$/gm)).toEqual(['time 0.5', 'time -1']);
  });

  it('compares as a dump with all its times', async () => {
    const files = ['a.skel', 'a.skin', 'a.anim'];
    write('mine.json', (await command(['pose', ...files, '--times', '0.25,1.5', '--vertices', '--json'], folder)).out);
    const found = await commandJson<{ times: { time: number }[] }>(['compare', ...files, 'mine.json'], folder);
    expect(found).toMatchObject({ agrees: true, compared: { world: 4, local: 4, vertices: 2, normals: 2 } });
    expect(found.times.map(({ time }) => time)).toEqual([0.25, 1.5]);
  });

  it('refuses two ways to say when', async () => {
    for (const others of [
      ['--time', '1'],
      ['--frame', '0'],
    ]) {
      expect((await command(['pose', 'a.skel', '--times', '1,2', ...others], folder)).code).toBe(2);
    }
    expect((await command(['pose', 'a.skel', '--times', ''], folder)).code).toBe(2);
  });
});

it('marrow channels --json has slopes at the times, and those of each key', async () => {
  type Curves = { readonly slopes: number[][]; readonly keys: { readonly slopeIn: number }[][] };
  const { slopes, keys } = await commandJson<Curves>(['channels', 'a.anim', '--times', '0,1,5'], folder);
  expect(slopes).toHaveLength(9);
  expect(slopes[5]).toEqual([0, -2, -2]);
  expect(keys[5]).toEqual([
    { time: 0, value: 0, slopeIn: 0, slopeOut: 0, tangentIn: 'flat', tangentOut: 'flat' },
    { time: 1, value: 3, slopeIn: 0.5, slopeOut: -2, tangentIn: 'smooth', tangentOut: 'linear' },
    { time: 2, value: 1, slopeIn: -2, slopeOut: -2, tangentIn: 'linear', tangentOut: 'linear' },
  ]);
  expect(keys[0]).toEqual([]);
});

it.each([
  ['a skin', 'a.skin', 'vertices are left as in the file'],
  ['an animation', 'a.anim', 'channels alone'],
])('%s without a skeleton says so', async (_, file, assumed) => {
  for (const args of [
    ['pose', file],
    ['info', file],
  ]) {
    const { code, err } = await command(args, folder);
    expect(code).toBe(0);
    expect(err).toContain(`${file} info skeleton-missing: Expected a skeleton with these files, found none.`);
    expect(err).toContain(assumed);
  }
});

it.each([
  ['motion capture', 'turn.bvh', 2],
  ['axis-angle skeletons', 'arm.axskel', 2],
])('marrow compare takes %s', async (_, file, joints) => {
  const { out } = await command(['pose', file, '--json', ...(file.endsWith('bvh') ? ['--frame', '1'] : [])], folder);
  const matrices = (JSON.parse(out) as PoseJson).characters[0].joints.map(({ world }) => world);
  write('theirs.json', JSON.stringify({ world: matrices, ...(file.endsWith('bvh') && { time: 0.5 }) }));
  const found = await commandJson<{ agrees: boolean }>(['compare', file, 'theirs.json'], folder);
  expect(found).toMatchObject({ agrees: true, compared: { world: joints } });
});

it('each command says what its exit codes mean', async () => {
  for (const { name } of COMMANDS) {
    const { code, out } = await command([name, '--help'], folder);
    expect(code).toBe(0);
    expect(out).toMatch(/\nExit codes: 0 .*, 1 .*, 2 wrong usage.*\.\n$/);
  }
  expect((await command(['--help'], folder)).out.match(/exits: 0 /g)).toHaveLength(COMMANDS.length);
});
