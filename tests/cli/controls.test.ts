/** Motion capture with goals or attachments beside it, written as `.bvh` on the command line: as it moves. */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, expect, it } from 'vitest';
import { command, commandJson, type PoseJson } from '../helpers/command.ts';

const folder = mkdtempSync(join(tmpdir(), 'marrow-controls-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const CHANNELS = 'CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation';
const TURNS = 'CHANNELS 3 Zrotation Xrotation Yrotation';
const walk = (name: string) => `HIERARCHY
ROOT ${name} {
  OFFSET 0 2 0
  ${CHANNELS}
  JOINT thigh { OFFSET 0.1 0 0 ${TURNS}
  JOINT shin { OFFSET 0 -1 0 ${TURNS}
  JOINT foot { OFFSET 0 -1 0 ${TURNS} End Site { OFFSET 0 0 0.3 } } } }
}
MOTION
Frames: 3
Frame Time: 0.1
0 2 0 0 0 0 0 -20 0 0 30 0 0 0 0
0.1 2 0 0 0 0 0 0 0 0 30 0 0 5 0
0.2 2 0 0 0 0 0 10 0 0 30 0 0 0 0
`;
const PROP = `HIERARCHY\nROOT hilt {\n  OFFSET 0 0 0\n  ${CHANNELS}\n  End Site { OFFSET 0 1 0 }\n}
MOTION\nFrames: 3\nFrame Time: 0.1\n${'0 0 0 0 0 0\n'.repeat(3)}`;
const FILES = {
  'walk.bvh': walk('hips'),
  'walk.limbs.json': JSON.stringify({
    ...{ base: 'walk.bvh' },
    limbs: [{ name: 'leg', joints: ['thigh', 'shin', 'foot'], bend: { dof: 'rx', sign: 1 } }],
    goals: [{ limb: 'leg', space: 'world', channels: { blend: 1, tx: 0.2, ty: 0.5, tz: 0.3 } }],
  }),
  'sword.bvh': PROP,
  'sword.attach.json': JSON.stringify({
    ...{ base: 'sword.bvh' },
    attached: [
      { character: 'walk', joint: 'foot', span: [0, 1], offset: { position: [0, 0, 0], rotation: [0, 0, 0] } },
    ],
  }),
};
for (const [name, text] of Object.entries(FILES)) writeFileSync(join(folder, name), text);

async function placeOf(files: readonly string[], joint: string): Promise<readonly number[]> {
  const { characters } = await commandJson<PoseJson>(['pose', ...files, '--time', '0.1'], folder);
  const found = characters.flatMap(({ joints }) => joints).find(({ name }) => name === joint);
  return found?.world.flat().slice(12, 15) ?? [];
}

it.each([
  ['goals of limbs', ['walk.bvh', 'walk.limbs.json'], 'foot'],
  ['an attachment', ['sword.bvh', 'sword.attach.json', 'walk.bvh', 'walk.limbs.json'], 'hilt'],
])('a take with %s is written to .bvh as it moves', async (_what, given, joint) => {
  const { code, err } = await command(['convert', ...given, 'out.bvh'], folder);
  expect(err).not.toMatch(/not needed|error/);
  expect(code).toBe(0);
  const [written, shown, raw] = [
    await placeOf(['out.bvh'], joint),
    await placeOf(given, joint),
    await placeOf(given.slice(0, 1), joint),
  ];
  expect(Math.hypot(...shown.map((value, k) => value - raw[k]))).toBeGreaterThan(0.1);
  shown.forEach((value, k) => {
    expect(written[k]).toBeCloseTo(value, 5);
  });
});

it('a take with nothing beside it that moves it is copied with its own numbers', async () => {
  expect((await command(['convert', 'walk.bvh', 'same.bvh'], folder)).code).toBe(0);
  const numbers = (text: string) => text.slice(text.indexOf('Frame Time')).trim().split(/\s+/).slice(3);
  expect(numbers(readFileSync(join(folder, 'same.bvh'), 'utf8'))).toEqual(numbers(FILES['walk.bvh']));
});
