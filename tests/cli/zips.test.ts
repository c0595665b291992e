/** A zip is taken wherever a folder is, with the same results. */
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, relative } from 'node:path';
import { zipSync } from 'fflate';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { saveCharacter } from '../../src/files/save/saving.ts';
import { character, skin, takeOfValues } from '../helpers/builders.ts';
import { command } from '../helpers/command.ts';
import { WALK } from './captures.ts';

let folder = '';
const hero = character({ skins: [skin()], takes: [takeOfValues('hero_walk', [0, 1, 0, 0, 0, 0, 0, 0, 0])] });
const text = (kind: 'skel' | 'skin' | 'anim') => saveCharacter(hero, kind)[0].text;

beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-zips-'));
  const character = { 'hero.skel': text('skel'), 'hero.skin': text('skin'), 'hero_walk.anim': text('anim') };
  put('hero', character);
  put('takes', { 'a/walk.bvh': WALK, 'b/run.bvh': WALK });
  put('one', { 'hero_walk.anim': text('anim') });
  put('bones', { 'hero.skel': text('skel') });
  put('dumps', { 'world.txt': '0 0 0\n0 2 0\n' });
  put('class/ann', character);
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

/** Writes a folder and a zip of the same files. */
function put(name: string, files: Readonly<Record<string, string>>): void {
  for (const [path, content] of Object.entries(files)) {
    mkdirSync(dirname(join(folder, name, path)), { recursive: true });
    writeFileSync(join(folder, name, path), content);
  }
  const bytes = Object.fromEntries(Object.entries(files).map(([path, content]) => [path, Buffer.from(content)]));
  writeFileSync(join(folder, `${name}.zip`), zipSync(bytes));
}

/** What was written below a folder, by path; a zip's files are in a folder of its name there. */
function written(name: string): ReadonlyMap<string, string> {
  const root = join(folder, name);
  const found = readdirSync(root, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile());
  return new Map(
    found.map((entry) => {
      const path = join(entry.parentPath, entry.name);
      // These tell where they come from.
      const isOfRun = /\.(ndjson|json|npz|parquet)$/.test(entry.name);
      return [relative(root, path).replace(/^(takes|hero)\//, ''), isOfRun ? '' : readFileSync(path, 'latin1')];
    }),
  );
}

it.each([
  ['info', '@hero'],
  ['info', '@takes'],
  ['pose', '@hero', '--time', '0.5'],
  ['channels', '@one', '--times', '0,1'],
  ['ik', '@hero', '--pin', '#1=0,1,0'],
  ['compare', '@bones', '@dumps'],
  ['grade', 'class', '--reference', '@hero', '--csv'],
  ['review', '@takes'],
])('%s %s answers of a zip what it does of a folder', async (...args) => {
  const of = (end: string) =>
    command(
      args.map((arg) => arg.replace(/^@(\w+)$/, `$1${end}`)),
      folder,
    );
  const [open, packed] = [await of(''), await of('.zip')];
  const plain = (out: string) => out.replaceAll('.zip', '').replace(/ +/g, ' ');
  expect(open.code, open.err).toBeLessThan(2);
  expect([packed.code, plain(packed.out), plain(packed.err)]).toEqual([open.code, plain(open.out), plain(open.err)]);
});

it.each([
  ...['skel', 'anim', 'bvh', 'rig', 'glb'].map((kind) => ['convert', '@takes', '--to', kind, '--out', '$']),
  ...['skel', 'anim', 'bvh', 'rig', 'glb'].map((kind) => ['convert', '@hero', '--to', kind, '--out', '$']),
  ...['skel', 'skin', 'anim', 'bvh', 'glb'].map((kind) => ['convert', '@hero', `$/out.${kind}`]),
  ...['npz', 'parquet', 'csv', 'json'].map((kind) => ['export', '@takes', '--to', kind, '--out', '$', '--no-times']),
  ['convert', '@takes', '--retarget', '@takes', '--to', 'bvh', '--out', '$'],
  ['convert', 'takes/a/walk.bvh', '--retarget', '@takes', '$/out.bvh'],
  ['export', '@takes', '--retarget', '@takes', '--space', '@takes', '--to', 'npz', '--out', '$', '--no-times'],
  ['convert', '@takes', '--to', 'bvh', '--mirror', '--out', '$'],
])('%s %s %s %s %s writes of a zip what it does of a folder', async (...args) => {
  const of = async (end: string, out: string) => {
    rmSync(join(folder, out), { recursive: true, force: true });
    mkdirSync(join(folder, out));
    const given = args.map((arg) => arg.replace(/^@(\w+)$/, `$1${end}`).replace('$', out));
    const { code, err } = await command(given, folder);
    expect(code, `${given.join(' ')}: ${err}`).toBe(0);
    return written(out);
  };
  const [open, packed] = [await of('', 'open'), await of('.zip', 'packed')];
  expect([...packed.keys()].sort()).toEqual([...open.keys()].sort());
  expect(open.size).toBeGreaterThan(0);
  for (const [path, content] of open) expect(packed.get(path) === content, path).toBe(true);
});
