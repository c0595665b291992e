/** `marrow page`. */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, expect, it } from 'vitest';
import { command } from '../helpers/command.ts';
import { filesIn, openedFrom } from '../helpers/saved-page.ts';

const SAMPLES = fileURLToPath(new URL('../../public/samples/', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'marrow-page-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

it('marrow page writes a page that shows the files, as the options say', async () => {
  const out = join(folder, 'walk.html');
  const files = ['walker.skel', 'walker.skin', 'walker_walk.anim'].map((name) => join(SAMPLES, name));
  const options = ['--take', 'walker_walk', '--time', '0.5', '--show', 'skin,bones', '--camera', '0,1,3,0,1,0'];
  const { code, out: said } = await command(['page', ...files, out, ...options, '--theme', 'dark', '--play']);
  expect([code, said]).toEqual([0, expect.stringMatching(/walk\.html: web page, \d+ bytes\n$/)]);
  const text = readFileSync(out, 'utf8');
  expect(text).toContain(
    '<marrow-viewer controls loop autoplay take="walker_walk" time="0.5" show="skin bones" camera="0,1,3,0,1,0" background="dark">',
  );
  expect([...filesIn(text).keys()]).toEqual(['walker/walker.skel', 'walker/walker.skin', 'walker/walker_walk.anim']);
  expect(openedFrom(text).characters.map(({ name }) => name)).toEqual(['walker']);
});

it('marrow page refuses what it can’t show, in a sentence', async () => {
  const skel = join(SAMPLES, 'walker.skel');
  const out = join(folder, 'none.html');
  for (const [args, message] of [
    [[skel], /needs at least one file, and a page to write that ends in \.html/],
    [[skel, 'out.htm', '--take', 'dance'], /--take takes one of no takes, found "dance"/],
    [[skel, out, '--camera', '1,2'], /--camera takes 6 numbers/],
    [[skel, out, '--show', 'feathers'], /--show takes some of nothing, skin/],
  ] as const) {
    const { code, err } = await command(['page', ...args], folder);
    expect(code).toBe(2);
    expect(err).toMatch(message);
  }
  const { code } = await command(['page', 'nowhere.skel', out], folder);
  expect(code).toBe(1);
});
