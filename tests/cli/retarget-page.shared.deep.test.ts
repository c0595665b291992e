/** The page and the command give the same numbers for the same take on the same character. */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { loadAny } from '../../src/cli/load.ts';
import { bakeRetarget, setRetarget } from '../../src/edit/commands/retarget.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import { bvhOf } from '../../src/files/save/character-files.ts';
import { bvhCopy } from '../../src/files/save/copies.ts';
import { outputOf, savedFileOf } from '../../src/files/save/output.ts';
import { type Character, EMPTY_DOCUMENT } from '../../src/model/document.ts';
import { command } from '../helpers/command.ts';
import { describeShared, sharedPath } from '../helpers/shared.ts';

let folder = '';
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-retarget-'));
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

/** As the page does it: both files are opened, the take is retargeted and baked, and saved as `.bvh`. */
async function byPage(take: string, target: string): Promise<string> {
  const { files } = await loadAny([sharedPath(take), sharedPath(target)], '/');
  const { document } = openFiles(EMPTY_DOCUMENT, files);
  const [source, character] = document.characters;
  const live = setRetarget.run(document, { characterId: character.id, sourceId: source.id });
  const baked = bakeRetarget.run(live, { characterId: character.id }).characters[1];
  const shown: Character = { ...baked, takes: [baked.takes[baked.shownTake]], shownTake: 0 };
  return savedFileOf(outputOf(bvhCopy('out.bvh', bvhOf(shown)))).text;
}

async function byCommand(take: string, target: string): Promise<string> {
  const args = ['convert', sharedPath(take), '--retarget', sharedPath(target), 'out.bvh'];
  expect(await command(args, folder)).toMatchObject({ code: 0 });
  return readFileSync(join(folder, 'out.bvh'), 'utf8');
}

describeShared('a take retargeted by the page and by the command', () => {
  it.each([
    ['data/bvh/mixamo-names.bvh', 'data/bvh/rokoko-dance.bvh'],
    ['data/bvh/mixamo-names.bvh', 'data/bvh/lafan1-dance-10frames.bvh'],
    ['data/bvh/rokoko-dance.bvh', 'data/bvh/bandai-namco-bow-normal.bvh'],
    ['data/bvh/lafan1-dance-10frames.bvh', 'data/bvh/cmu-01_01.bvh'],
    ['data/field/fbx-centimetre-idle.fbx', 'data/bvh/poser-sl-walk.bvh'],
    ['data/bvh/cmu-01_01.bvh', 'data/field/gltf-metre-skeleton.gltf'],
  ])('has the same numbers, to the digit: %s on %s', async (take, target) => {
    expect(await byCommand(take, target)).toBe(await byPage(take, target));
  });
});
