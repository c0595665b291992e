import { expect, it } from 'vitest';
import { matchPaths } from '../../src/review/match-paths.ts';

const listed = (...paths: string[]) => paths.map((path) => ({ path }));
const pairs = (takes: readonly { readonly path: string }[], ...paths: string[]) =>
  [...matchPaths(takes, paths).found].map(([path, take]) => `${path} = ${take.path}`);

it('a path of a list means the file whose path ends with it, and the other way round', () => {
  expect(pairs(listed('takes/a.bvh'), '../lab/takes/a.bvh')).toEqual(['../lab/takes/a.bvh = takes/a.bvh']);
  expect(pairs(listed('/home/lab/takes/a.bvh'), './takes/a.bvh')).toEqual(['./takes/a.bvh = /home/lab/takes/a.bvh']);
  expect(pairs(listed('lab/takes/a.bvh'), 'C:\\lab\\takes\\a.bvh')).toEqual([
    'C:\\lab\\takes\\a.bvh = lab/takes/a.bvh',
  ]);
});

it('files of one name in different folders are not mistaken for each other', () => {
  expect(pairs(listed('one/a.bvh'), 'two/a.bvh')).toEqual([]);
  expect(pairs(listed('one/a.bvh', 'two/a.bvh'), 'x/two/a.bvh', 'x/one/a.bvh')).toEqual([
    'x/two/a.bvh = two/a.bvh',
    'x/one/a.bvh = one/a.bvh',
  ]);
});

it('the longest path counts, and what no file is, is told', () => {
  const takes = listed('a.bvh', 'x/a.bvh', 'gone.bvh');
  expect(pairs(takes, 'y/x/a.bvh')).toEqual(['y/x/a.bvh = x/a.bvh']);
  expect(matchPaths(takes, ['y/x/a.bvh']).missing.map(({ path }) => path)).toEqual(['a.bvh', 'gone.bvh']);
});
