/** What the command opens together, from folders and zips, and what it calls the files that it writes. */
import { mkdirSync, mkdtempSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { strToU8, zipSync } from 'fflate';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { saveCharacter } from '../../src/files/save/saving.ts';
import { character, joint, takeOfValues } from '../helpers/builders.ts';
import { command } from '../helpers/command.ts';

let folder = '';
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-'));
});
afterEach(() => rmSync(folder, { recursive: true, force: true }));

const hero = character({
  skeleton: { name: 'hero', joints: [joint(-1), joint(0)] },
  takes: [takeOfValues('walk', [0, 0, 0, 0.1, 0.2, 0.3, 0, 0, 0])],
  shownTake: 0,
});
const [SKEL, ANIM, BVH] = (['skel', 'anim', 'bvh'] as const).map((kind) => saveCharacter(hero, kind)[0].text);
const write = (path: string, content: string | Uint8Array) => {
  mkdirSync(join(folder, path, '..'), { recursive: true });
  writeFileSync(join(folder, path), content);
};
const zipped = (files: Readonly<Record<string, string>>) =>
  zipSync(Object.fromEntries(Object.entries(files).map(([name, text]) => [name, strToU8(text)])));
const allIn = (path: string) =>
  readdirSync(join(folder, path), { recursive: true, encoding: 'utf8' })
    .filter((name) => statSync(join(folder, path, name)).isFile())
    .sort();
const filesIn = (path: string) => readdirSync(join(folder, path)).sort();
const json = async (...args: string[]) => JSON.parse((await command([...args, '--json'], folder)).out);

/** A GLB whose only take is called mixamo.com. */
async function mixamo(path: string): Promise<void> {
  write('parts/hero.skel', SKEL);
  write('parts/mixamo.com.anim', ANIM);
  mkdirSync(join(folder, path, '..'), { recursive: true });
  const { code, err } = await command(['convert', 'parts/hero.skel', 'parts/mixamo.com.anim', path], folder);
  expect([code, err]).toEqual([0, expect.not.stringContaining('error')]);
}

describe('files of takes with one name', () => {
  it.each(['bvh', 'anim', 'skel', 'rig'])('marrow convert --to %s names them by their inputs', async (to) => {
    for (const stem of ['wave', 'nod', 'Wave']) await mixamo(`takes/${stem}.glb`);
    const { code, err } = await command(['convert', 'takes', '--to', to, '--out', 'out'], folder);
    expect([code, err]).toEqual([0, expect.not.stringContaining('error')]);
    const written = filesIn('out');
    expect(new Set(written.map((name) => name.toLowerCase())).size).toBe(written.length);
    for (const stem of ['nod', 'wave', 'wave_2']) {
      expect(written.some((name) => name.toLowerCase().startsWith(`${stem}.`))).toBe(true);
    }
    if (to === 'bvh') expect(written).toHaveLength(3);
    if (to !== 'skel' && to !== 'rig') return;
    // Each take finds its skeleton again, and nothing else does.
    const { characters } = await json('info', 'out');
    expect(characters.map(({ takes }: { takes: readonly string[] }) => takes.length)).toEqual([1, 1, 1]);
  });
});

describe('a take of a .skel for another kind of character', () => {
  it('goes to motion capture in all commands, whatever the order', async () => {
    write('in/fig.bvh', BVH);
    write('in/jump.anim', ANIM);
    for (const order of [['in/fig.bvh', 'in/jump.anim'], ['in/jump.anim', 'in/fig.bvh'], ['in']]) {
      const { characters } = await json('info', ...order);
      expect(characters).toMatchObject([{ takes: ['fig', 'jump'] }]);
    }
    expect((await command(['convert', 'in', '--to', 'bvh', '--out', 'out', '--fps', '30'], folder)).code).toBe(0);
    expect(filesIn('out')).toEqual(['fig.bvh', 'jump.bvh']);
    const { out } = await command(['review', 'in'], folder);
    expect(
      out
        .split('\n')
        .slice(1, -1)
        .map((line) => line.split(',')[0]),
    ).toEqual(['in/fig.bvh', 'in/jump.anim']);
    const exported = await command(['export', 'in', '--to', 'json', '--out', 'data'], folder);
    expect([exported.code, exported.err]).toEqual([0, '']);
    expect(filesIn('data')).toEqual(['fig.json', 'jump.json', 'manifest.ndjson']);
  });

  it('of several characters, the one left out of a .glb is an error, and nothing is written', async () => {
    for (const stem of ['a', 'b']) write(`in/${stem}.skel`, SKEL);
    write('in/jump.anim', ANIM);
    const { code, err } = await command(['convert', 'in', 'out.glb'], folder);
    expect([code, err]).toEqual([1, expect.stringContaining('in/jump.anim error part-unused')]);
    expect(filesIn('.')).toEqual(['in']);
  });
});

describe('zips', () => {
  it('are read as folders are', async () => {
    const files = { 'hero.skel': SKEL, 'moves/walk.anim': ANIM, 'readme.md': 'x', '__MACOSX/._hero.skel': 'x' };
    write('pack.zip', zipped(files));
    const { characters, diagnostics } = await json('info', 'pack.zip');
    expect(diagnostics).toEqual([]);
    expect(characters).toMatchObject([{ name: 'hero', takes: ['walk'] }]);
    expect((await json('pose', 'pack.zip', '--time', '0.5')).characters).toHaveLength(1);
    expect((await command(['review', 'pack.zip'], folder)).out).toContain('pack.zip/moves/walk.anim,');
    expect((await command(['convert', 'pack.zip', 'hero.glb'], folder)).code).toBe(0);
    expect(filesIn('.')).toEqual(['hero.glb', 'pack.zip']);
  });

  it.each([[], ['--mirror'], ['--crop', '0,0.05'], ['--retarget', 'target.bvh']])(
    'are converted below a folder of their name, with or without edits: %s',
    async (...edit) => {
      write('target.bvh', BVH);
      write('in/pack.zip', zipped({ 'hero.skel': SKEL, 'moves/walk.anim': ANIM, 'captures/fig.bvh': BVH }));
      const both = ['pack/captures/fig.bvh', 'pack/moves/walk.bvh'];
      const { code, err } = await command(['convert', 'in', '--to', 'bvh', ...edit, '--out', 'out'], folder);
      expect([code, err]).toEqual([0, expect.not.stringContaining('error')]);
      expect(allIn('out').filter((name) => name !== 'manifest.ndjson')).toEqual(both);
      if (edit.length > 0) return;
      // Next to the zip, as if it had been unpacked there.
      expect((await command(['convert', 'in/pack.zip', '--to', 'bvh'], folder)).code).toBe(0);
      expect(allIn('in')).toEqual(['pack.zip', ...both]);
    },
  );

  it('are exported by bytes, which --resume compares, and by the paths of a list', async () => {
    const pack = (anim: string) => write('pack.zip', zipped({ 'hero.skel': SKEL, 'walk.anim': anim, 'fig.bvh': BVH }));
    pack(ANIM);
    write('pack/fig.bvh', BVH);
    const args = ['export', 'pack.zip', 'pack/fig.bvh', '--to', 'json', '--out', 'out', '--resume'];
    expect(await command(args, folder)).toMatchObject({ code: 0, err: '' });
    // Next to what was unpacked from it, a zip keeps its ending.
    const outputs = ['pack.zip/fig.json', 'pack.zip/walk.json', 'pack/fig.json'];
    expect(allIn('out')).toEqual(['manifest.ndjson', ...outputs]);
    expect((await command(args, folder)).out).toContain('nothing to do');
    pack(`${ANIM}\n`);
    expect((await command(args, folder)).out).toContain('1 take exported');
    await command(['review', 'pack.zip', '--out', 'list.csv'], folder);
    const listed = await command(['export', '--only', 'list.csv', '--to', 'json', '--out', 'listed'], folder);
    expect(listed).toMatchObject({ code: 0, err: '' });
    expect(allIn('listed')).toEqual(['manifest.ndjson', 'pack/fig.json', 'pack/walk.json']);
  });

  it('that are damaged are failures of an export, which goes on', async () => {
    write('in/pack.zip', 'PK is missing');
    write('in/fig.bvh', BVH);
    const { code, err } = await command(['export', 'in', '--to', 'json', '--out', 'out'], folder);
    expect([code, err]).toEqual([1, expect.stringContaining("in/pack.zip: The archive can't be unpacked")]);
    expect(allIn('out')).toEqual(['fig.json', 'manifest.ndjson']);
  });

  it.each([
    ['none', 'PK is missing', 'zip-unreadable'],
    ['without files that are read', zipSync({ 'a.md': strToU8('x') }), 'zip-empty'],
  ])('say what is wrong: %s', async (_, content, code) => {
    write('pack.zip', content);
    const told = await command(['info', 'pack.zip'], folder);
    expect([told.code, told.err]).toEqual([1, expect.stringContaining(code)]);
  });
});

describe('files of which nothing can be read', () => {
  it.each(['info', 'pose'])('marrow %s fails and says so', async (name) => {
    write('a.sto', ':version 1.10');
    const { code, err } = await command([name, 'a.sto'], folder);
    expect([code, err]).toEqual([1, expect.stringContaining('error nothing-read')]);
    write('hero.skel', SKEL);
    expect((await command([name, 'a.sto', 'hero.skel'], folder)).code).toBe(0);
  });

  it('marrow pose fails if there is no character', async () => {
    write('numbers.txt', '1 2 3\n4 5 6\n');
    const { code, err } = await command(['pose', 'numbers.txt'], folder);
    expect([code, err]).toEqual([1, expect.stringContaining('error character-missing')]);
  });
});

it('a file written from one input alone says which are not needed', async () => {
  write('hero.skel', SKEL);
  write('walk.anim', ANIM);
  const { code, err } = await command(['convert', 'hero.skel', 'walk.anim', 'out.skel'], folder);
  expect([code, err]).toEqual([0, expect.stringContaining('walk.anim is not needed')]);
});
