/** Motion capture on the command line, as scripts see it. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { command, commandJson, type InfoJson, type PoseJson } from '../helpers/command.ts';
import { conformance, describeShared, sharedPath } from '../helpers/shared.ts';

const root = (name: string) => `ROOT ${name} {
  OFFSET 1 2 3
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Arm { OFFSET 0 10 0 CHANNELS 1 Zrotation End Site { OFFSET 0 5 0 } End Site { } }
}
`;
const TWO = `HIERARCHY
${root('Left')}${root('Right')}MOTION
Frames: 3
Frame Time: 0.5
0 0 0 0 0 0 0  9 0 0 0 0 0 0
1 0 0 0 0 0 90  9 0 0 90 0 0 0
2 0 0 0 0 0 0  9 0 0 0 0 0 0
`;

let folder = '';
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-bvh-'));
  writeFileSync(join(folder, 'two.bvh'), TWO);
  writeFileSync(join(folder, 'still.bvh'), `HIERARCHY\n${root('Still')}MOTION\nFrames: 0\nFrame Time: 0.5\n`);
  writeFileSync(
    join(folder, 'short.bvh'),
    `HIERARCHY\n${root('x')}MOTION\nFrames: 1\nFrame Time: 0.5\n0 0 0 0 0 0 0\n`,
  );
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const pose = async (...args: string[]) => (await commandJson<PoseJson>(['pose', ...args], folder)).characters;
const at = (character: PoseJson['characters'][0]) => [
  ...character.joints.map(({ world }) => world.slice(12, 15)),
  ...(character.endSites ?? []).map(({ position }) => position),
];
const rounded = (points: readonly (readonly number[])[]) =>
  points.map((p) => p.map((x) => Math.round(1e9 * x) / 1e9 + 0));

describe('marrow info, of motion capture', () => {
  it('counts joints, End Sites, DOFs, roots and frames', async () => {
    const { files } = await commandJson<InfoJson>(['info', 'two.bvh', 'still.bvh'], folder);
    expect(files).toEqual([
      {
        ...{ name: 'two.bvh', kind: 'bvh', loaded: true, joints: 4, endSites: 4, dofs: 14, roots: 2 },
        ...{ frames: 3, frameTime: 0.5, duration: 1 },
      },
      { name: 'still.bvh', kind: 'bvh', loaded: true, joints: 2, endSites: 2, dofs: 7, roots: 1, frames: 0 },
    ]);
    expect((await command(['info', 'two.bvh'], folder)).out).toContain('frames 3, frameTime 0.5, duration 1');
  });
});

describe('marrow pose, of motion capture', () => {
  it('marrow pose, of motion capture has a character for each root, with End Sites in the order of the file', async () => {
    const [left, right] = await pose('two.bvh', '--frame', '1');
    expect(left.endSites?.map(({ joint }) => joint)).toEqual([1, 1]);
    expect(rounded(at(left))).toEqual([
      [1, 0, 0],
      [1, 10, 0],
      [-4, 10, 0],
      [1, 10, 0],
    ]);
    expect(rounded(at(right))).toEqual([
      [9, 0, 0],
      [-1, 0, 0],
      [-6, 0, 0],
      [-1, 0, 0],
    ]);
  });

  it('poses a frame as it does its time, and the rest pose without either', async () => {
    expect(await pose('two.bvh', '--frame', '2')).toEqual(await pose('two.bvh', '--time', '1'));
    expect(rounded(at((await pose('two.bvh'))[0]))).toEqual([
      [1, 2, 3],
      [1, 12, 3],
      [1, 17, 3],
      [1, 12, 3],
    ]);
  });

  it('prints End Sites as text too', async () => {
    expect((await command(['pose', 'two.bvh', '--frame', '0'], folder)).out).toContain('end site of 1: 0 15 0');
  });

  it.each([
    ['beyond the last frame', ['two.bvh', '--frame', '3'], '0 to 2, the frames of "two Left"'],
    [
      'beyond the frames of one of several takes',
      ['two.bvh', 'short.bvh', '--frame', '1'],
      '0 to 0, the frames of "short"',
    ],
    ['before the first frame', ['two.bvh', '--frame', '-1'], '0 to 2'],
    ['between frames', ['two.bvh', '--frame', '0.5'], 'whole number'],
    ['a frame of what has none', ['still.bvh', '--frame', '0'], 'no samples'],
    ['a frame and a time', ['two.bvh', '--frame', '0', '--time', '0'], 'Give only one of --time, --times and --frame'],
  ])('refuses %s, and says what there is', async (_, args, said) => {
    const { code, out, err } = await command(['pose', ...args], folder);
    expect({ code, out }).toEqual({ code: 2, out: '' });
    expect(err).toContain(said);
  });
});

interface Reference {
  readonly frames: number;
  readonly frame_time: number;
  readonly channels: number;
  readonly nodes: readonly (readonly [string, number, string | null])[];
  readonly rest: readonly (readonly number[])[];
  readonly positions: Readonly<Record<string, readonly (readonly number[])[]>>;
  readonly positions_add?: Readonly<Record<string, readonly (readonly number[])[]>>;
  readonly tolerance: number;
}

describeShared('the motion capture of the reference, through the command', () => {
  const { files } = conformance<{ files: Readonly<Record<string, Reference>> }>('bvh-positions.json');
  const SHARED = sharedPath('');

  it.each(Object.entries(files))(
    'marrow gives counts and positions of %s as the reference has them',
    async (name, expected) => {
      const path = `data/bvh/${name}`;
      const isEnd = expected.nodes.map(([, , channels]) => channels === null);
      const info = (await commandJson<InfoJson>(['info', path], SHARED)).files[0];
      const endSites = isEnd.filter((is) => is).length;
      expect(info).toMatchObject({ joints: isEnd.length - endSites, endSites, dofs: expected.channels });
      expect(info).toMatchObject({ frames: expected.frames });
      expect(info.frameTime).toBeCloseTo(expected.frame_time, 9);

      const check = async (options: readonly string[], points: readonly (readonly number[])[]) => {
        const { characters } = await commandJson<PoseJson>(['pose', path, ...options], SHARED);
        const joints = characters.flatMap((c) => c.joints.map(({ world }) => world.slice(12, 15)));
        const ends = characters.flatMap((c) => (c.endSites ?? []).map(({ position }) => position));
        const got = isEnd.map((is) => (is ? ends.shift() : joints.shift()) ?? [Number.NaN, Number.NaN, Number.NaN]);
        const off = points.flatMap((point, n) => point.map((x, k) => Math.abs(got[n][k] - x)));
        expect(off.filter((each) => !(each <= expected.tolerance))).toEqual([]);
      };
      await check([], expected.rest);
      // Where the file's writer meant OFFSET + channel, that is recognised.
      for (const [frame, points] of Object.entries(expected.positions_add ?? expected.positions)) {
        await check(['--frame', frame], points);
      }
    },
  );
});

describe('marrow convert, to .skel and .anim and back', () => {
  const rate = async (name: string) => {
    const [{ frameTime, frames }] = (await commandJson<InfoJson>(['info', name], folder)).files;
    return [frames, frameTime];
  };
  const text = (seconds: string) =>
    `HIERARCHY\n${root('Box')}MOTION\nFrames: 4\nFrame Time: ${seconds}\n${'0 0 0 0 0 10 20\n1 0 0 0 5 90 30\n'.repeat(2)}`;

  it.each(['0.01', '0.008333', '0.0333333'])(
    'marrow convert, to .skel and .anim and back keeps a frame time of %s s without being told',
    async (seconds) => {
      writeFileSync(join(folder, 'box.bvh'), text(seconds));
      expect((await command(['convert', 'box.bvh', 'box.skel'], folder)).code).toBe(0);
      expect((await command(['convert', 'box.bvh', 'box.anim'], folder)).code).toBe(0);
      const back = await command(['convert', 'box.skel', 'box.anim', 'back.bvh'], folder);
      expect([back.code, back.err]).toEqual([0, '']);
      expect(await rate('back.bvh')).toEqual([4, Number(seconds)]);
    },
  );

  it('reports that keys at arbitrary times are written at 30 frames per second', async () => {
    writeFileSync(join(folder, 'slow.bvh'), text('0.5'));
    await command(['convert', 'slow.bvh', 'slow.skel'], folder);
    await command(['convert', 'slow.bvh', 'slow.anim'], folder);
    const { code, err } = await command(['convert', 'slow.skel', 'slow.anim', 'slow-back.bvh'], folder);
    expect([code, err]).toEqual([0, expect.stringContaining('info rate-assumed')]);
    expect(await rate('slow-back.bvh')).toEqual([46, 1 / 30]);
    const told = await command(['convert', 'slow.skel', 'slow.anim', 'slow-back.bvh', '--fps', '2'], folder);
    expect([told.code, told.err]).toEqual([0, '']);
    expect(await rate('slow-back.bvh')).toEqual([4, 0.5]);
  });
});
