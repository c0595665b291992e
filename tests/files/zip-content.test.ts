/** Paths of files in zips. */
import { strToU8, zipSync } from 'fflate';
import { expect, it } from 'vitest';
import { zipContent } from '../../src/files/zip-content.ts';

it('no path in a zip leads out of it, and no file is lost for its path', () => {
  const paths = ['../a.skel', '/b.skel', 'x\\..\\..\\c.skel', './d/../e.skel', 'f/.hidden/g.skel', 'h..skel'];
  const { files, passedOver } = zipContent(
    'in/pack.zip',
    zipSync(Object.fromEntries(paths.map((path) => [path, strToU8(path)]))),
    (name) => name.endsWith('.skel'),
  );
  expect(files.map(({ path }) => path.slice('in/pack.zip/'.length)).sort()).toEqual([
    'a.skel',
    'b.skel',
    'd/e.skel',
    'f/.hidden/g.skel',
    'h..skel',
    'x/c.skel',
  ]);
  expect(passedOver).toEqual([]);
});
