/** Parts in other folders than their skeletons, as in projects with `skeletons/`, `skins/` and `animations/`. */
import { expect, it } from 'vitest';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { animFile, skeleton, skelFile, skin, skinFile, takeOfValues } from '../../helpers/builders.ts';
import { expectLinearTime } from '../../helpers/growth.ts';

const given = (path: string) => {
  if (path.endsWith('.skel')) return skelFile(path, skeleton(2, path));
  return path.endsWith('.skin') ? skinFile(path, skin(path)) : animFile(path, takeOfValues(path, [0]));
};

/** The files of each character. */
const opened = (...paths: string[]) =>
  openFiles(EMPTY_DOCUMENT, paths.map(given)).document.characters.map(({ sources }) => sources.map(({ path }) => path));

it('a part belongs to the skeleton called like it in a folder beside its own', () => {
  const wasp = ['skels/wasp.skel', 'skins/wasp.skin', 'anims/wasp_walk.anim'];
  expect(opened(...wasp, 'skels/tube.skel', 'skins/tube_smooth.skin')).toEqual([
    wasp,
    ['skels/tube.skel', 'skins/tube_smooth.skin'],
  ]);
});

it('of equal names the skeleton in the closest folder has the part', () => {
  expect(
    opened('2/skel/wasp.skel', '3/skel/wasp.skel', '3/skin/wasp.skin', '2/skin/wasp.skin', '2/skel/test.skel'),
  ).toEqual([['2/skel/wasp.skel', '2/skin/wasp.skin'], ['3/skel/wasp.skel', '3/skin/wasp.skin'], ['2/skel/test.skel']]);
});

it('a part belongs to none where two are as close, or where only letters of a word agree', () => {
  const characters = opened('a/wasp.skel', 'b/wasp.skel', 'a/te.skel', 'c/wasp.skin', 'c/tentacle.skin');
  expect(characters).toContainEqual(['c/wasp.skin']);
  expect(characters).toContainEqual(['c/tentacle.skin']);
});

it('the skeletons of its own folder come before others', () => {
  expect(opened('a/hero.skel', 'b/hero_run.skel', 'a/hero_run.skin')).toEqual([
    ['a/hero.skel', 'a/hero_run.skin'],
    ['b/hero_run.skel'],
  ]);
});

it('the time to match grows with the number of files in folders', () => {
  expectLinearTime(
    (n) => opened(...Array.from({ length: n }, (_, i) => [`${i}/s/c.skel`, `${i}/k/c.skin`]).flat()),
    150,
  );
});
