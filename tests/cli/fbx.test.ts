/** `marrow` on FBX files: told, posed, written as text and read back. */
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, expect, it } from 'vitest';
import { command } from '../helpers/command.ts';
import { walkingBones } from '../import/fbx/walking-bones.ts';
import { fbxBytes, fbxText } from '../import/fbx/write-fbx.ts';

const folder = mkdtempSync(join(tmpdir(), 'marrow-fbx-'));
afterAll(() => rmSync(folder, { recursive: true }));

interface Posed {
  readonly frames: readonly {
    readonly characters: readonly {
      readonly joints: readonly { readonly name: string; readonly world: readonly number[] }[];
      readonly positions: readonly number[];
    }[];
  }[];
}

async function posed(...files: string[]): Promise<Posed> {
  const { code, out } = await command(['pose', ...files, '--times', '0,0.3,0.77,1', '--vertices', '--json'], folder);
  expect(code).toBe(0);
  return JSON.parse(out) as Posed;
}

it('an FBX file, binary or text, written as text by --to rig moves as before', async () => {
  writeFileSync(join(folder, 'hero.fbx'), fbxBytes(walkingBones));
  writeFileSync(join(folder, 'text.fbx'), fbxText(walkingBones));
  const { code, out } = await command(['convert', 'hero.fbx', '--to', 'rig', '--out', 'out/'], folder);
  expect(code).toBe(0);
  expect(out).toContain('hero.skel');
  const written = readdirSync(join(folder, 'out')).map((name) => `out/${name}`);
  expect(written.map((name) => name.replace(/.*\./, '')).sort()).toEqual(['anim', 'rig', 'skel', 'skin']);
  const [binary, text, back] = [await posed('hero.fbx'), await posed('text.fbx'), await posed(...written)];
  for (const [f, { characters }] of binary.frames.entries()) {
    for (const other of [text, back]) {
      const [own, its] = [characters[0], other.frames[f].characters[0]];
      expect(its.joints.map(({ name }) => name)).toEqual(own.joints.map(({ name }) => name));
      for (const [j, { world }] of own.joints.entries()) {
        for (const [k, value] of world.entries()) expect(its.joints[j].world[k]).toBeCloseTo(value, 9);
      }
      for (const [k, value] of own.positions.entries()) expect(its.positions[k]).toBeCloseTo(value, 9);
    }
  }
});

it('a damaged FBX file is told with the byte, and the command fails', async () => {
  const bytes = fbxBytes(walkingBones);
  writeFileSync(join(folder, 'cut.fbx'), bytes.slice(0, 500));
  const { code, err } = await command(['info', 'cut.fbx'], folder);
  expect(code).toBe(1);
  expect(err).toMatch(/cut\.fbx.*cut off.*at byte \d+/);
});
