/** GLB files on the command line, as scripts see them. */
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { type CommandResult, command, commandJson, type PoseJson } from '../helpers/command.ts';

const SAMPLES = fileURLToPath(new URL('../../public/samples/', import.meta.url));
const JOINTS = ['joints.rig', 'joints.skel', 'joints.skin', 'joints_each.anim', 'joints.png'].map((n) => SAMPLES + n);

/** 1/2000 of the example's size, in its units. */
const TOLERANCE = 9.4 / 2000;

let folder = '';
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-glb-'));
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const jsonOf = (name: string) => {
  const bytes = readFileSync(join(folder, name));
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString('utf8'));
};

/** Of all joints, written once. */
let converted: Promise<CommandResult> | undefined;
const jointsGlb = () => {
  converted ??= command(['convert', ...JOINTS, 'a.glb'], folder);
  return converted;
};

describe('marrow convert to .glb', () => {
  it('convert writes a character as GLB, says what is not in it, and gives the same bytes again', async () => {
    const { code, out, err } = await jointsGlb();
    expect(code).toBe(0);
    expect(out).toMatch(/^a\.glb: glTF, \d+ bytes\n$/);
    expect(err).toContain("a.glb info joints-split: glTF nodes can't shear");
    expect(err).toContain('Not in the file: limits of 16 joints (applied) and linked DOFs of 1 joint (applied).');
    await command(['convert', ...JOINTS, 'b.glb'], folder);
    expect(readFileSync(join(folder, 'b.glb')).equals(readFileSync(join(folder, 'a.glb')))).toBe(true);
    const { nodes, animations, images } = jsonOf('a.glb');
    expect(nodes[0]).toMatchObject({ name: 'joints' });
    expect(nodes[0]).not.toHaveProperty('scale');
    expect(animations.map(({ name }: { name: string }) => name)).toEqual(['joints_each']);
    expect(images).toHaveLength(1);
  });

  it('a GLB file that was written here is read as the character that it was written from', async () => {
    await jointsGlb();
    for (const time of ['0.4', '1.37', '5.5']) {
      const jointsOf = async (files: readonly string[]) => {
        const { characters } = await commandJson<PoseJson>(['pose', ...files, '--time', time, '--json'], folder);
        return characters[0].joints;
      };
      const read = new Map((await jointsOf(['a.glb'])).map(({ name, world }) => [name, world]));
      for (const { name, world } of await jointsOf(JOINTS)) {
        const theirs = read.get(name) ?? [];
        const off = Math.hypot(...[12, 13, 14].map((k) => theirs[k] - world[k]));
        // Once the tolerance of writing, once that of reading.
        expect(off, `${name} at ${time}`).toBeLessThanOrEqual(2 * TOLERANCE);
      }
    }
  });

  it('convert takes the skin out of a whole character, and says what else it names', async () => {
    await jointsGlb();
    const { code, out, err } = await command(['convert', 'a.glb', 'own.skin'], folder);
    expect([code, out.startsWith('own.skin: skin, ')]).toEqual([0, true]);
    expect(err).toMatch(/It names .*\.png, which would not be written\. "--to rig --out DIR" writes all parts\./);
    const vertices = async (files: readonly string[]) =>
      (await commandJson<PoseJson>(['pose', ...files, '--vertices', '--json'], folder)).characters[0].positions;
    const whole = await vertices(['a.glb']);
    await command(['convert', 'a.glb', 'own.skel'], folder);
    expect(await vertices(['own.skel', 'own.skin'])).toEqual(whole);
  });

  it('a take that is one of several in a file is refused with how to write all of them', async () => {
    writeFileSync(join(folder, 'two.anim'), readFileSync(`${SAMPLES}joints_each.anim`));
    await command(['convert', ...JOINTS, 'two.anim', 'two.glb'], folder);
    const { code, err } = await command(['convert', 'two.glb', 'one.anim'], folder);
    expect(code).toBe(1);
    expect(err).toContain('found 2 (joints_each.anim, two.anim). "--to anim --out DIR" writes each.');
  });

  it('convert --fps writes one key a frame', async () => {
    expect((await command(['convert', ...JOINTS, 'fps.glb', '--fps', '10'], folder)).code).toBe(0);
    const { animations, accessors } = jsonOf('fps.glb');
    const counts = animations[0].samplers.map(({ input }: { input: number }) => accessors[input].count);
    expect(Math.max(...counts)).toBe(61);
  });

  it('convert --keys cubic writes fewer keys than linear ones', async () => {
    await jointsGlb();
    await command(['convert', ...JOINTS, 'cubic.glb', '--keys', 'cubic'], folder);
    const keys = (name: string) => {
      const { animations, accessors } = jsonOf(name);
      return animations[0].samplers.reduce(
        (sum: number, { input }: { input: number }) => sum + accessors[input].count,
        0,
      );
    };
    expect(keys('cubic.glb')).toBeLessThan(keys('a.glb') / 2);
  });

  it('a skeleton without a skin gets bones to be seen by, unless --no-body', async () => {
    const skeleton = JOINTS[1];
    await command(['convert', skeleton, 'body.glb'], folder);
    await command(['convert', skeleton, 'bare.glb', '--no-body'], folder);
    expect(jsonOf('body.glb')).toHaveProperty('skins');
    expect(jsonOf('bare.glb')).not.toHaveProperty('meshes');
    expect(jsonOf('bare.glb').nodes).toHaveLength(26);
  });

  it.each([
    [['--keys', 'bezier'], '--keys takes one of linear, cubic, found "bezier".'],
    [['--influences', '0'], '--influences takes a whole number of at least 1, found "0".'],
  ])('convert refuses %j', async (options, message) => {
    const { code, err } = await command(['convert', ...JOINTS, 'no.glb', ...options], folder);
    expect(code).toBe(2);
    expect(err).toContain(message);
    expect(existsSync(join(folder, 'no.glb'))).toBe(false);
  });

  it('End Sites are said to be no joints of a file in which bones reach them', async () => {
    const text =
      'HIERARCHY\nROOT a {\nOFFSET 0 0 0\nCHANNELS 1 Zrotation\nEnd Site { OFFSET 0 1 0 } End Site { OFFSET 1 0 0 } }\nMOTION\nFrames: 1\nFrame Time: 1\n0\n';
    writeFileSync(join(folder, 'ends.bvh'), text);
    const { err } = await command(['convert', 'ends.bvh', 'ends.glb'], folder);
    expect(err).toContain('Not in the file: 2 End Sites as joints (bones reach them).');
    expect((await command(['convert', 'ends.bvh', 'ends.glb', '--no-body'], folder)).err).toContain(
      'Not in the file: 2 End Sites.',
    );
  });

  it('boxes are the body, and are said to be left out without one or where they are far too large', async () => {
    const joint = (name: string, inside = '') =>
      `balljoint ${name} { offset 0 9 0 boxmin -1 0 -1 boxmax 1 9 1 ${inside}}`;
    const said = async (skeleton: string, ...more: string[]) => {
      writeFileSync(join(folder, 'sword.skel'), skeleton);
      return (await command(['convert', 'sword.skel', 'sword.glb', ...more], folder)).err;
    };
    const sword = joint('grip', joint('blade'));
    expect(await said(sword)).not.toContain('boxes');
    expect(await said(sword, '--no-body')).toContain('Not in the file: boxes of 2 joints.');
    const crowd = `balljoint root { ${'balljoint j { offset 0 .1 0 boxmin -1 0 -1 boxmax 1 9 1 } '.repeat(20)} }`;
    expect(await said(crowd)).toContain('boxes of 21 joints (bones are shown instead).');
  });

  it('convert says which takes there are when it is asked for another, and writes nothing', async () => {
    const { code, err } = await command(['convert', ...JOINTS, 'no.glb', '--take', 'run'], folder);
    expect(code).toBe(1);
    expect(err).toContain('joints has no take run; its takes are joints_each.');
    expect(existsSync(join(folder, 'no.glb'))).toBe(false);
  });

  it('options for .glb are refused for other outputs', async () => {
    const { code, err } = await command(['convert', JOINTS[1], 'a.bvh', '--keys', 'cubic'], folder);
    expect(code).toBe(2);
    expect(err).toContain('--keys is for .glb files; the output must end in .glb.');
  });
});
