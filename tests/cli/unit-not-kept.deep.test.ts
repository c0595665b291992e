/** What is said where text files lose the unit that a character's file states. */
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { statedSpace } from '../../src/evaluate/space/metres.ts';
import { unitNotKept } from '../../src/files/save/unit-not-kept.ts';
import { character } from '../helpers/builders.ts';
import { command } from '../helpers/command.ts';
import { describeShared, sharedPath } from '../helpers/shared.ts';

let folder = '';
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-unit-'));
});
afterEach(() => rmSync(folder, { recursive: true, force: true }));

it('that a unit is not kept is said of characters whose file states one', () => {
  expect(unitNotKept(character({ space: statedSpace(0.01).space }))).toMatch(/^The unit, centimetres, is not kept: /);
  expect(unitNotKept(character({ space: statedSpace(0.3).space }))).toMatch(/^The unit, units of 0.3 m, is not kept: /);
  expect(
    unitNotKept(character({ space: { up: 'y', unit: 'centimetres', lift: 0, known: 'guessed' } })),
  ).toBeUndefined();
  expect(unitNotKept(character())).toBeUndefined();
});

describeShared('a character with a unit, converted', () => {
  const fbx = sharedPath('data/field/fbx-centimetre-idle.fbx');
  const glb = sharedPath('data/gltf/Fox.glb');
  const said = async (...args: readonly string[]) => {
    const { code, err } = await command(['convert', ...args], folder);
    expect(code).toBe(0);
    return err.match(/info unit-not-kept: .*/g) ?? [];
  };

  it.each([
    [[fbx, 'idle.skel'], 'centimetres'],
    [[fbx, 'idle.bvh'], 'centimetres'],
    [[glb, 'fox.skin'], 'metres'],
    [[glb, '--to', 'rig', '--out', 'fox'], 'metres'],
  ])('%j says once that the unit is not kept, and what keeps it', async (args, unit) => {
    const all = await said(...args);
    expect(all).toHaveLength(1);
    expect(all[0]).toContain(`The unit, ${unit}, is not kept`);
    expect(all[0]).toContain('A .glb or .fbx keeps the size');
  });

  it('is said once of many characters, with their number', async () => {
    const nods = sharedPath('data/field/same-take-name');
    expect(await said(nods, fbx, '--to', 'skel', '--out', 'all')).toEqual([
      expect.stringMatching(/The unit, centimetres, is not kept: .* The same goes for 2 more\.$/),
    ]);
  });

  it('is not said of formats that keep it or have no lengths', async () => {
    expect(await said(glb, 'fox.glb')).toEqual([]);
    expect(await said(sharedPath('data/cse169/wasp.skel'), 'wasp.bvh')).toEqual([]);
  });
});
