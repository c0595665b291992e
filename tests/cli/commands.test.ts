/** The command as a function, on small files of its own. */
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { command, commandJson, type InfoJson, type PoseJson } from '../helpers/command.ts';

const SKEL = `balljoint root {
  balljoint tip { offset 0 2 0 rotxlimit -1 1 pose 0.25 0 0 }
}
`;
const ROW = '0 0 0 1 0 0 0 1 0';
const SKIN = `positions 3 { ${ROW} }
normals 3 { 0 0 1 0 0 1 0 0 1 }
skinweights 3 { 1 0 1 1 1 1 1 1 1 }
triangles 1 { 0 1 2 }
bindings 2 {
  matrix { 1 0 0 0 1 0 0 0 1 0 0 0 }
  matrix { 1 0 0 0 1 0 0 0 1 0 2 0 }
}
`;
const MORPH = 'positions 1 { 0 0 0 5 }\nnormals 0 { }\n';
const channel = (value: number) => `channel { extrapolate constant constant keys 1 { 0 ${value} flat flat } }`;
const ANIM = `animation { range 0 1 numchannels 10 ${[1, 2, 3, 0, 0, 0, 9, 0, 0, 0.5].map(channel).join('\n')} }\n`;

let folder = '';
const FILES: Readonly<Record<string, string>> = {
  'hero.skel': SKEL,
  'hero.skin': SKIN,
  'hero.morph': MORPH,
  'hero_walk.anim': ANIM,
  'broken.skel': 'balljoint root {\n\toffset 0 1,5 0\n}\n',
  'two words, 50%.skel': SKEL,
  'many/a10.skel': SKEL,
  'many/a9.skel': SKEL,
  'many/.hidden': 'no one reads this',
  'note.txt': 'hello',
};

beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-'));
  for (const [name, text] of Object.entries(FILES)) {
    mkdirSync(dirname(join(folder, name)), { recursive: true });
    writeFileSync(join(folder, name), text);
  }
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const HERO = ['hero.skel', 'hero.skin', 'hero.morph', 'hero_walk.anim'];
const pose = async (...args: string[]) => (await commandJson<PoseJson>(['pose', ...args], folder)).characters[0];

describe('marrow', () => {
  it('prints help when asked, and on unknown arguments', async () => {
    const asked = await command(['--help'], folder);
    expect(asked).toMatchObject({ code: 0, err: '' });
    for (const name of ['info', 'pose', 'channels', 'convert']) expect(asked.out).toContain(`marrow ${name}`);
    expect(await command([], folder)).toMatchObject({ code: 2, out: '' });
    expect(await command(['dance'], folder)).toMatchObject({ code: 2, out: '' });
    expect((await command(['pose', '--help'], folder)).out).toContain('--dofs');
  });

  it.each([
    ['an unknown option', ['info', 'hero.skel', '--jsn']],
    ['no file', ['info']],
    ['a root of two numbers', ['pose', 'hero.skel', '--root', '1,2']],
    ['a word for a time', ['pose', 'hero.skel', '--time', 'noon']],
    ['too few DOFs', ['pose', 'hero.skel', '--dofs', '1,2,3']],
    ['DOFs without a skeleton', ['pose', 'hero.skin', '--dofs', '1,2,3']],
    ['too many morph weights', ['pose', ...HERO, '--morphs', '1,2']],
    ['no times', ['channels', 'hero_walk.anim']],
    ['channels of a skeleton', ['channels', 'hero.skel', '--times', '0']],
    ['nothing to convert', ['convert', 'hero.skel']],
    ['a format that is not known', ['convert', 'hero.skel', 'hero.doc']],
  ])('calls %s wrong usage', async (_, args) => {
    const { code, out, err } = await command(args, folder);
    expect({ code, out }).toEqual({ code: 2, out: '' });
    expect(err).toContain('usage: marrow');
  });

  it('tells how many DOFs it expects', async () => {
    expect((await command(['pose', 'hero.skel', '--dofs', '1'], folder)).err).toContain('takes 6 numbers');
  });
});

describe('marrow info', () => {
  it('reports a folder without readable files', async () => {
    mkdirSync(join(folder, 'nothing'));
    const { code, out, err } = await command(['info', 'nothing'], folder);
    expect([code, out]).toEqual([1, '']);
    expect(err).toContain('error nothing-found: There are no readable files here');
    const json = await commandJson<InfoJson>(['info', 'nothing', '--json'], folder, 1);
    expect(json).toMatchObject({ files: [], diagnostics: [{ code: 'nothing-found' }] });
  });

  it('marrow info counts what each file holds', async () => {
    const { files } = await commandJson<InfoJson>(['info', ...HERO], folder);
    expect(files).toMatchObject([
      { name: 'hero.skel', kind: 'skel', joints: 2, dofs: 6, roots: 1 },
      { name: 'hero.skin', kind: 'skin', vertices: 3, triangles: 1, maxAttachments: 1, bindings: 2, texcoords: 0 },
      { name: 'hero.morph', kind: 'morph', positions: 1, normals: 0 },
      { name: 'hero_walk.anim', kind: 'anim', channels: 10, keys: 10, range: [0, 1] },
    ]);
  });

  it('marrow info names the materials of a skin and their textures', async () => {
    const block = 'triangles 1 { 0 0 0 }';
    const text = `positions 1 { 0 0 0 } material fur { texture fur.png } ${block} material eye { color 0 0 1 } ${block}`;
    writeFileSync(join(folder, 'fox.skin'), text);
    const { files } = await commandJson<InfoJson>(['info', 'fox.skin'], folder);
    expect(files).toMatchObject([{ triangles: 2, materials: ['fur', 'eye'], textures: ['fur.png'] }]);
  });

  it('says what dumps hold, in words', async () => {
    writeFileSync(join(folder, 'mine@1.5.txt'), '1 2 3 4\n5 6 7 8\n9 10 11 12\n');
    writeFileSync(join(folder, 'takes.txt'), ['0', '1', '2', '3'].map((t) => `time ${t}\n1 2 3\n4 5 6\n`).join(''));
    const { out } = await command(['info', 'mine@1.5.txt', 'takes.txt'], folder);
    expect(out).toContain('mine@1.5.txt  dump     blocks 1 (time 1.5, rows 3, numbers 12)');
    expect(out).toContain(
      'blocks 4 (time 0, rows 2, numbers 6; time 1, rows 2, numbers 6; time 2, rows 2, numbers 6; …)',
    );
  });

  it('shows the offending line with a caret', async () => {
    const { code, err } = await command(['info', 'broken.skel'], folder);
    expect(code).toBe(1);
    expect(err).toContain('broken.skel:2:11 error not-a-number: ');
    expect(err).toContain('    \toffset 0 1,5 0\n    \t         ^');
  });

  it('reports a missing file, and still the others', async () => {
    const { files, diagnostics } = await commandJson<InfoJson>(['info', 'gone.skin', 'hero.skel'], folder, 1);
    expect(files).toMatchObject([
      { name: 'gone.skin', loaded: false },
      { name: 'hero.skel', loaded: true },
    ]);
    expect(diagnostics).toContainEqual(expect.objectContaining({ severity: 'error', code: 'file-missing', line: 0 }));
  });

  it('reports what does not match between files', async () => {
    writeFileSync(join(folder, 'one.skel'), 'balljoint root { }');
    const { diagnostics } = await commandJson<InfoJson>(['info', 'one.skel', 'hero.skin'], folder, 1);
    expect(diagnostics.filter((d) => d.severity === 'error').map((d) => d.file)).toEqual(['hero.skin']);
    rmSync(join(folder, 'one.skel'));
  });

  it('expands a folder to its files, in natural order and without hidden ones', async () => {
    const { files } = await commandJson<InfoJson>(['info', 'many'], folder);
    expect(files.map((f) => f.name)).toEqual(['many/a9.skel', 'many/a10.skel']);
  });

  it('reads names with blanks, commas and percents, and each file once', async () => {
    const args = ['info', 'two words, 50%.skel', './two words, 50%.skel'];
    expect((await commandJson<InfoJson>(args, folder)).files).toHaveLength(1);
  });

  it('skips files that it does not read, with a warning', async () => {
    const { diagnostics } = await commandJson<InfoJson>(['info', 'note.txt', 'hero.skel'], folder);
    expect(diagnostics).toMatchObject([{ severity: 'warning', code: 'format-unknown', file: 'note.txt' }]);
  });

  it('prints text without --json', async () => {
    const { out } = await command(['info', ...HERO], folder);
    expect(out).toContain('joints 2, dofs 6, roots 1');
    expect(out).toContain('character hero: hero.skel, hero.skin, hero.morph, hero_walk.anim');
  });
});

describe('marrow pose', () => {
  it('prints the file pose by default, even with an animation', async () => {
    const character = await pose(...HERO);
    expect(character).toMatchObject({ name: 'hero', root: [0, 0, 0], morphs: [{ name: 'hero', weight: 0 }] });
    expect(character.joints.map((j) => j.dofs)).toEqual([
      [0, 0, 0],
      [0.25, 0, 0],
    ]);
    expect(character.positions).toBeUndefined();
  });

  it('lets --time animate root, joints within their limits, and morphs', async () => {
    const character = await pose(...HERO, '--time=-100', '--vertices');
    expect(character.root).toEqual([1, 2, 3]);
    expect(character.joints[1].dofs).toEqual([1, 0, 0]);
    expect(character.morphs[0].weight).toBe(0.5);
    expect(character.positions?.slice(0, 3)).toEqual([1, 2, 5.5]);
  });

  it('lets --root, --dofs and --morphs each override the animation, and only their own part', async () => {
    expect((await pose(...HERO, '--time', '0', '--root', '-7,0,0')).root).toEqual([-7, 0, 0]);
    expect((await pose(...HERO, '--time', '0', '--root', '-7,0,0')).joints[1].dofs).toEqual([1, 0, 0]);
    const bent = await pose(...HERO, '--time', '0', '--dofs', '0,0,0,-5,0.5,0', '--morphs=-2');
    expect(bent.joints[1].dofs).toEqual([-1, 0.5, 0]);
    expect(bent.root).toEqual([1, 2, 3]);
    expect(bent.morphs[0].weight).toBe(-2);
  });

  it('prints the undeformed skin without a skeleton', async () => {
    const character = await pose('hero.skin', '--vertices', '--time', '3', '--root', '1,1,1');
    expect(character.joints).toEqual([]);
    expect(character.positions?.join(' ')).toBe(ROW);
    expect(character.bounds).toEqual({ min: [0, 0, 0], max: [1, 1, 0] });
  });

  it('bounds the joints if there is no skin', async () => {
    expect((await pose('hero.skel', '--root', '1,0,0')).bounds).toEqual({ min: [1, 0, 0], max: [1, 2, 0] });
  });

  it('prints several characters if the files contain several', async () => {
    const { characters } = await commandJson<PoseJson>(['pose', 'many'], folder);
    expect(characters.map((c) => c.name)).toEqual(['a9', 'a10']);
  });

  it('exits with 1 for a broken file, and poses the rest', async () => {
    const { characters } = await commandJson<PoseJson>(['pose', 'broken.skel', 'hero.skel'], folder, 1);
    expect(characters.map((c) => c.name)).toEqual(['hero']);
  });
});

describe('marrow convert', () => {
  const written = (name: string) => readFileSync(join(folder, name), 'utf8');
  const convert = (...args: string[]) => command(['convert', ...args], folder);

  it('writes each format back, and its own output to the same bytes', async () => {
    for (const name of HERO) {
      const extension = name.slice(name.lastIndexOf('.'));
      expect(await convert(name, `once${extension}`)).toMatchObject({ code: 0, err: '' });
      expect(await convert(`once${extension}`, `twice${extension}`)).toMatchObject({ code: 0, err: '' });
      expect(written(`twice${extension}`)).toBe(written(`once${extension}`));
    }
  });

  it('picks the content that OUT asks for from several files', async () => {
    await convert(...HERO, 'picked.skin');
    await convert('hero.skin', 'alone.skin');
    expect(written('picked.skin')).toBe(written('alone.skin'));
  });

  it('writes a rig of the given names', async () => {
    await convert(...HERO, 'made.rig');
    const { files, diagnostics } = await commandJson<InfoJson>(['info', 'made.rig', ...HERO], folder);
    expect(files[0]).toMatchObject({ kind: 'rig', parts: HERO });
    expect(diagnostics).toEqual([]);
  });

  it('refuses, with a message, content that IN does not have, or has twice', async () => {
    const missing = await convert('hero.skel', 'none.skin');
    expect(missing).toMatchObject({ code: 1, out: '' });
    expect(missing.err).toContain('Expected skin input');
    expect(existsSync(join(folder, 'none.skin'))).toBe(false);
    expect((await convert('hero.skel', 'many/a9.skel', 'both.skel')).err).toContain('Name only one');
  });

  it('leaves existing files unchanged if it fails, and no temporary ones', async () => {
    writeFileSync(join(folder, 'kept.skel'), SKEL);
    const before = readdirSync(folder);
    expect((await convert('broken.skel', 'kept.skel')).code).toBe(1);
    expect(written('kept.skel')).toBe(SKEL);
    expect((await convert('hero.skel', 'no/such/folder.skel')).code).toBe(3);
    mkdirSync(join(folder, 'folder.skel'));
    expect((await convert('hero.skel', 'folder.skel')).code).toBe(3);
    expect(statSync(join(folder, 'folder.skel')).isDirectory()).toBe(true);
    rmSync(join(folder, 'folder.skel'), { recursive: true });
    expect(readdirSync(folder)).toEqual(before);
  });

  it('marrow convert may overwrite the file that it read', async () => {
    writeFileSync(join(folder, 'same.skel'), SKEL);
    expect((await convert('same.skel', 'same.skel')).code).toBe(0);
    await convert('hero.skel', 'other.skel');
    expect(written('same.skel')).toBe(written('other.skel'));
  });
});

describe('marrow convert of motion capture', () => {
  const BVH = `HIERARCHY
ROOT Hips
{
	OFFSET 0 90 0
	CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
	JOINT Chest
	{
		OFFSET 0 20 0
		CHANNELS 2 Xrotation Yrotation
		End Site
		{
			OFFSET 0 15 0
		}
	}
}
MOTION
Frames: 3
Frame Time: 0.05
0 90 0 0 0 0 0 0
1 91 0 0 10 0 0.1 170
2 92 0 0 20 0 0.2 190
`;
  const at = (...path: string[]) => join(folder, ...path);
  const convert = (...args: string[]) => command(['convert', ...args], folder);
  const tree = (path: string) => (readdirSync(at(path), { recursive: true }) as string[]).sort();

  beforeAll(() => {
    for (const [name, text] of Object.entries({
      'takes/walk.bvh': BVH,
      'takes/broken.bvh': BVH.replace('0 0 10', '0 0 1x0'),
      'takes/more/run.bvh': BVH,
      'takes/read.me': 'no one converts this',
      'walk.bvh': BVH,
    })) {
      mkdirSync(dirname(at(name)), { recursive: true });
      writeFileSync(at(name), text);
    }
  });

  it('rewrites motion capture to the same bytes, and at another frame rate on request', async () => {
    expect(await convert('walk.bvh', 'again.bvh')).toMatchObject({ code: 0, err: '' });
    expect(readFileSync(at('again.bvh'), 'utf8')).toBe(BVH);
    expect(await convert('walk.bvh', 'slow.bvh', '--fps', '10')).toMatchObject({ code: 0 });
    expect(readFileSync(at('slow.bvh'), 'utf8')).toContain('Frames: 2\nFrame Time: 0.1\n');
  });

  it('writes .skel and .anim by the extension of OUT, and .bvh from those again', async () => {
    expect(await convert('walk.bvh', 'w.skel')).toMatchObject({ code: 0, err: '' });
    expect(await convert('walk.bvh', 'w.anim')).toMatchObject({ code: 0, err: '' });
    expect(readFileSync(at('w.skel'), 'utf8')).toContain('freejoint Hips {');
    expect(await convert('w.skel', 'w.anim', 'back.bvh', '--fps', '20')).toMatchObject({ code: 0, err: '' });
    const ends = ['0.05', '--json'] as const;
    const before = await commandJson<PoseJson>(['pose', 'walk.bvh', '--time', ends[0]], folder);
    const after = await commandJson<PoseJson>(['pose', 'back.bvh', '--time', ends[0]], folder);
    const worlds = ({ characters }: PoseJson) => characters[0].joints.flatMap(({ world }) => world);
    worlds(before).forEach((v, i) => {
      expect(worlds(after)[i]).toBeCloseTo(v, 9);
    });
  });

  it('writes fewer keys within a tolerance', async () => {
    await convert('walk.bvh', 'all.anim');
    await convert('walk.bvh', 'few.anim', '--tolerance', '0.001');
    const keys = async (name: string) => (await commandJson<InfoJson>(['info', name], folder)).files[0].keys;
    expect(await keys('all.anim')).toBe(24);
    expect(await keys('few.anim')).toBeLessThan(24);
  });

  it('refuses a frame rate that gives too many frames, in one file or in many', async () => {
    const one = await convert('walk.bvh', 'mad.bvh', '--fps', '1e12');
    expect(one).toMatchObject({ code: 1, out: '' });
    expect(one.err).toMatch(
      /mad\.bvh error conversion-refused: walk would have [\d,]+ frames, but the maximum is 1,000,000/,
    );
    const many = await convert('walk.bvh', '--to', 'bvh', '--out', 'mad', '--fps', '1e12');
    expect(many.code).toBe(1);
    expect(many.err).toContain('walk.bvh error conversion-refused');
  });

  it('converts a folder to another one, continues after broken files, and exits with an error', async () => {
    const { code, out, err } = await convert('takes', '--to', 'skel', '--out', 'made');
    expect(code).toBe(1);
    expect(err).toContain('broken.bvh:');
    expect(
      out
        .split('\n')
        .filter(Boolean)
        .map((line) => line.split(':')[0]),
    ).toEqual(['made/more/run.skel', 'made/more/run.anim', 'made/walk.skel', 'made/walk.anim']);
    expect(tree('made')).toEqual(['more', 'more/run.anim', 'more/run.skel', 'walk.anim', 'walk.skel']);
    rmSync(at('takes', 'broken.bvh'));
    expect(await convert('made', '--to', 'bvh', '--out', 'back')).toMatchObject({ code: 0, err: '' });
    expect(tree('back')).toEqual(['more', 'more/run.bvh', 'walk.bvh']);
  });

  it('writes next to its input, and overwrites nothing unasked', async () => {
    mkdirSync(at('beside'));
    writeFileSync(at('beside', 'walk.bvh'), BVH);
    writeFileSync(at('beside', 'walk.anim'), 'mine');
    const { code, err, out } = await convert('beside', '--to', '.anim');
    expect({ code, out }).toEqual({ code: 1, out: '' });
    expect(err).toContain('--force to overwrite');
    expect(readFileSync(at('beside', 'walk.anim'), 'utf8')).toBe('mine');
    rmSync(at('beside', 'walk.bvh'));
    writeFileSync(at('beside', 'walk.bvh'), BVH);
    rmSync(at('beside', 'walk.anim'));
    expect(await convert('beside/walk.bvh', '--to', 'anim', '--force')).toMatchObject({ code: 0, err: '' });
    expect(readFileSync(at('beside', 'walk.anim'), 'utf8')).toContain('numchannels 8');
  });

  it('files of the wanted kind stay as they are, which is said; another frame rate needs a place or --force', async () => {
    mkdirSync(at('same'));
    for (const name of ['a.bvh', 'b.bvh']) writeFileSync(at('same', name), BVH);
    const kept = await convert('same', '--to', 'bvh');
    expect(kept).toMatchObject({ code: 0, out: '' });
    expect(kept.err).toContain('2 files are already .bvh files and are left as they are');
    const slower = await convert('same', '--to', 'bvh', '--fps', '20');
    expect(slower).toMatchObject({ code: 1, out: '' });
    expect(slower.err.match(/This would overwrite the file/g)).toHaveLength(2);
    for (const name of ['a.bvh', 'b.bvh']) expect(readFileSync(at('same', name), 'utf8')).toBe(BVH);
    expect(await convert('same', '--to', 'bvh', '--fps', '20', '--force')).toMatchObject({ code: 0, err: '' });
    expect(readFileSync(at('same', 'a.bvh'), 'utf8')).toContain('Frame Time: 0.05');
  });

  it('marrow convert of motion capture says what it needs', async () => {
    expect(await convert('walk.bvh', '--to', 'gif')).toMatchObject({ code: 2 });
    expect(await convert('walk.bvh', 'x.bvh', '--fps', '0')).toMatchObject({ code: 2 });
    expect(await convert('walk.bvh', 'x.bvh', '--force')).toMatchObject({ code: 2 });
    const alone = await convert('hero_walk.anim', '--to', 'bvh', '--out', 'none');
    expect(alone.code).toBe(1);
    expect(alone.err).toContain('Add its skeleton');
    expect(await convert('note.txt', '--to', 'bvh')).toMatchObject({ code: 1 });
  });
});
