/** A take written as GLB on another character: all of that character, with the take as its only animation. */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { loadAny } from '../../src/cli/load.ts';
import { setRetarget } from '../../src/edit/commands/retarget.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import { type Character, EMPTY_DOCUMENT } from '../../src/model/document.ts';
import { vertexCount } from '../../src/model/skin.ts';
import { frameTimes, Points, requireSkeleton } from '../evaluate/retarget/captures.ts';
import { command } from '../helpers/command.ts';
import { describeShared, sharedPath } from '../helpers/shared.ts';

let folder = '';
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-retarget-'));
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const TAKE = sharedPath('data/bvh/mixamo-names.bvh');
const CHARACTER = sharedPath('data/field/gltf-metre-skeleton.gltf');

/** The JSON of a GLB file. Tests check what they read of it. */
function jsonOf(name: string) {
  const bytes = readFileSync(join(folder, name));
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString('utf8'));
}

async function opened(...paths: string[]): Promise<readonly Character[]> {
  return openFiles(EMPTY_DOCUMENT, (await loadAny(paths, folder)).files).document.characters;
}

/** As the page shows it. */
async function live(...target: string[]): Promise<readonly [source: Character, target: Character]> {
  const { document } = openFiles(EMPTY_DOCUMENT, (await loadAny([TAKE, ...target], folder)).files);
  const [source, character] = document.characters;
  const after = setRetarget.run(document, { characterId: character.id, sourceId: source.id });
  return [source, after.characters[1]];
}

describeShared('marrow convert TAKE --retarget CHARACTER OUT.glb', () => {
  it('writes the joints of the character, where the page shows them, in one animation', async () => {
    expect(await command(['convert', TAKE, '--retarget', CHARACTER, 'out.glb'], folder)).toMatchObject({ code: 0 });
    expect(jsonOf('out.glb').animations).toHaveLength(1);
    const [source, shown] = await live(CHARACTER);
    const [written] = await opened('out.glb');
    const names = ({ skeleton }: Character) => skeleton?.joints.map(({ name }) => name) ?? [];
    const [own, meant] = [new Points(written), new Points(shown)];
    for (const seconds of frameTimes(source, 12)) {
      own.pose(seconds);
      meant.pose(seconds);
      names(shown).forEach((name, j) => {
        const other = names(written).indexOf(name);
        for (let k = 0; k < 3; k++) expect(own.at[3 * other + k] - meant.at[3 * j + k]).toBeCloseTo(0, 2);
      });
    }
  });

  it('writes its skin, also of a character in several files', async () => {
    const wasp = ['skel', 'skin'].map((kind) => sharedPath(`data/cse169/wasp.${kind}`));
    const given = wasp.flatMap((path) => ['--retarget', path]);
    expect(await command(['convert', TAKE, ...given, 'wasp.glb'], folder)).toMatchObject({ code: 0 });
    const [{ skeleton, skins }] = await opened(...wasp);
    const { meshes, accessors, animations, skins: written } = jsonOf('wasp.glb');
    expect(accessors[meshes[0].primitives[0].attributes.POSITION].count).toBe(vertexCount(skins[0]));
    expect(written[0].joints.length).toBeGreaterThanOrEqual(skeleton?.joints.length ?? 0);
    expect(animations).toHaveLength(1);
  });

  it('crops and mirrors on the way, without a target too', async () => {
    const { code } = await command(['convert', TAKE, '--crop', '0.5,1', '--mirror', 'cut.glb'], folder);
    expect(code).toBe(0);
    const [cut] = await opened('cut.glb');
    const [start, end] = cut.takes[0].range;
    expect(end - start).toBeCloseTo(0.5, 3);
    expect(requireSkeleton(cut).joints.length).toBeGreaterThan(50);
  });

  it('with --to glb each take of a folder is the character with that take', async () => {
    const takes = ['mixamo-names', 'lafan1-dance-10frames'].map((name) => sharedPath(`data/bvh/${name}.bvh`));
    const args = ['convert', ...takes, '--retarget', CHARACTER, '--to', 'glb', '--out', 'all'];
    expect(await command(args, folder)).toMatchObject({ code: 0 });
    for (const name of ['mixamo-names', 'lafan1-dance-10frames']) {
      const { animations, nodes } = jsonOf(`all/${name}.glb`);
      expect(animations).toHaveLength(1);
      expect(nodes.length).toBeLessThan(30);
    }
  });

  it('tells what it lacks, as for other files', async () => {
    const { code, err } = await command(
      ['convert', sharedPath('data/cse169/wasp.skel'), '--retarget', CHARACTER, 'none.glb'],
      folder,
    );
    expect([code, err]).toEqual([1, expect.stringContaining('needs a skeleton and a take to retarget from')]);
  });
});
