/** FBX files and VRM animations on the command line, as scripts see them. */
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { command, commandJson, type PoseJson } from '../helpers/command.ts';
import { OWN_CAPTURES } from '../helpers/own-files.ts';

const SAMPLES = fileURLToPath(new URL('../../public/samples/', import.meta.url));
const JOINTS = ['joints.rig', 'joints.skel', 'joints.skin', 'joints_each.anim', 'joints.png'].map((n) => SAMPLES + n);
const WALKER = ['walker.rig', 'walker.skel', 'walker.skin', 'walker_walk.anim'].map((n) => SAMPLES + n);
/** 1/2000 of the example's size, in its units. */
const TOLERANCE = 9.4 / 2000;

let folder = '';
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-fbx-'));
  for (const [name, bytes] of OWN_CAPTURES) writeFileSync(join(folder, name), bytes);
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

describe('marrow convert to .fbx and .vrma', () => {
  it('convert writes a character as FBX, says what is not in it, and gives the same bytes again', async () => {
    const { code, out, err } = await command(['convert', ...JOINTS, 'a.fbx'], folder);
    expect(code).toBe(0);
    expect(out).toMatch(/^a\.fbx: FBX, \d+ bytes\n$/);
    expect(err).toContain('a.fbx info joints-split: FBX nodes move, then turn, then scale');
    expect(err).toContain('Not in the file: limits of 16 joints (applied) and linked DOFs of 1 joint (applied).');
    await command(['convert', ...JOINTS, 'b.fbx'], folder);
    expect(readFileSync(join(folder, 'b.fbx')).equals(readFileSync(join(folder, 'a.fbx')))).toBe(true);
  });

  it('an FBX file that was written here is read as the character that it was written from', async () => {
    await command(['convert', ...JOINTS, 'a.fbx'], folder);
    for (const time of ['0.4', '1.37', '5.5']) {
      const jointsOf = async (files: readonly string[]) => {
        const { characters } = await commandJson<PoseJson>(['pose', ...files, '--time', time, '--json'], folder);
        return characters[0].joints;
      };
      const read = new Map((await jointsOf(['a.fbx'])).map(({ name, world }) => [name, world]));
      for (const { name, world } of await jointsOf(JOINTS)) {
        const theirs = read.get(name) ?? [];
        const off = Math.hypot(...[12, 13, 14].map((k) => theirs[k] - world[k]));
        expect(off, `${name} at ${time}`).toBeLessThanOrEqual(TOLERANCE);
      }
    }
  });

  it('convert --to fbx writes a file for each capture', async () => {
    const { code } = await command(
      ['convert', 'own-walk.bvh', 'own-walk-z.bvh', '--to', 'fbx', '--out', 'all'],
      folder,
    );
    expect(code).toBe(0);
    expect(
      readdirSync(join(folder, 'all'))
        .filter((name) => name.endsWith('.fbx'))
        .sort(),
    ).toEqual(['own-walk-z.fbx', 'own-walk.fbx']);
  });

  it('convert writes the motion of a humanoid as a VRM animation, and names the bones that another lacks', async () => {
    const { code, err } = await command(['convert', ...WALKER, 'walk.vrma'], folder);
    expect(code).toBe(0);
    expect(err).toContain('A VRM animation turns bones and moves the hips.');
    const refused = await command(['convert', ...JOINTS, 'no.vrma'], folder);
    expect(refused.code).toBe(1);
    expect(refused.err).toMatch(/has none for .*leftUpperArm/);
  });

  it.each([
    ['--keys', 'cubic', 'x.fbx', '--keys is for .glb files; the output must end in .glb.'],
    ['--influences', '4', 'x.vrma', '--influences is for .glb or .fbx files; the output must end in .glb or .fbx.'],
    ['--take', 'walk', 'x.bvh', '--take is for .glb, .fbx or .vrma files; the output must end in .glb, .fbx or .vrma.'],
  ])('convert %s %s %s is refused, since it means nothing there', async (option, value, out, message) => {
    const { code, err } = await command(['convert', 'own-walk.bvh', option, value, out], folder);
    expect(code).toBe(2);
    expect(err).toContain(message);
  });
});
