/** Attached characters on the command line: what is printed and written is where the joint of the leader takes it. */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, it } from 'vitest';
import { type Character, type Document, findCharacter } from '../../src/model/document.ts';
import { differenceOf, sceneOf } from '../edit/attach/attached.ts';
import { savedOf, scene } from '../files/open/attached-files.ts';
import { command, commandJson, type PoseJson } from '../helpers/command.ts';
import { jointsInThree } from '../helpers/glb.ts';

const folder = mkdtempSync(join(tmpdir(), 'marrow-attach-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const BEFORE: Document = scene();
const FILES = savedOf(BEFORE);
for (const [name, text] of FILES) writeFileSync(join(folder, name), text);
const SWORD = ['sword.skel', 'sword_anim.base.anim', 'sword_anim.anim', 'sword_anim.attach.json'];
const WALKER = ['walker.skel', 'walker_walk.anim'];
const sword = (): Character => {
  const found = findCharacter(BEFORE, 'c2');
  if (!found) throw new Error('no sword');
  return found;
};

describe('an attached character on the command line', () => {
  it('is posed where the joint takes it', async () => {
    const found = await commandJson<PoseJson>(['pose', ...SWORD, ...WALKER, '--time', '1'], folder);
    const root = found.characters.find(({ name }) => name === 'sword')?.joints[0].world ?? [];
    expect(differenceOf(Float64Array.from(root.flat()), sceneOf(sword(), 0, 1))).toBeLessThan(1e-9);
  });

  it.each(['glb', 'bvh', 'fbx'])('is written to .%s alone, with the motion that its leader gives it', async (kind) => {
    const out = `alone.${kind}`;
    const { code, err } = await command(['convert', ...SWORD, ...WALKER, out], folder);
    expect(err).not.toMatch(/error/i);
    expect(code).toBe(0);
    const written = await commandJson<PoseJson>(['pose', out, '--time', '1'], folder);
    const root = written.characters[0].joints.find(({ name }) => name === 'hilt') ?? written.characters[0].joints[0];
    const meant = sceneOf(sword(), 0, 1);
    const off = [12, 13, 14].map((k) => Math.abs(root.world.flat()[k] - meant[k]));
    expect(Math.max(...off)).toBeLessThan(kind === 'fbx' ? 1e-2 : 4e-3);
  });

  it('is in the same place beside its leader in three.js, each written as .glb', async () => {
    await command(['convert', ...SWORD, ...WALKER, 'sword.glb'], folder);
    await command(['convert', ...WALKER, 'walker.glb'], folder);
    const inThree = async (name: string, joint: string) => jointsInThree(readFileSync(join(folder, name)), [joint]);
    const [hilt, hand] = [await inThree('sword.glb', 'hilt'), await inThree('walker.glb', 'joint1')];
    const { offset } = sword().takes[0].attached?.list[0] ?? {};
    const held = Math.hypot(...(offset?.position ?? []));
    for (const time of [0.5, 0.61, 0.87, 1.13, 1.49]) {
      const [[at], [of]] = [hilt(time), hand(time)];
      expect(Math.hypot(...at.map((value, k) => value - of[k]))).toBeCloseTo(held, 3);
      const meant = sceneOf(sword(), 0, time);
      expect(Math.hypot(...at.map((value, k) => value - meant[12 + k]))).toBeLessThan(1e-3);
    }
  });

  it('is written to .anim as it moves, or as the plain file has it without its leader', async () => {
    expect((await command(['convert', ...SWORD, ...WALKER, 'out.anim'], folder)).code).toBe(0);
    expect(readFileSync(join(folder, 'out.anim'), 'utf8')).toBe(FILES.get('sword_anim.anim'));
  });

  it('is told as it is where what it follows is not there', async () => {
    const { out } = await command(['info', 'sword_anim.attach.json', '--json'], folder);
    expect(JSON.parse(out).files[0]).toMatchObject({
      kind: 'attach',
      attached: [{ character: 'walker', joint: 'joint1', span: [0.5, 1.5] }],
    });
    const alone = await command(['pose', ...SWORD, '--time', '1'], folder);
    expect(alone.err).toContain('attach-leader-missing');
  });
});
