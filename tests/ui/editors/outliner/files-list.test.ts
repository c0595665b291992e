import { expect, it } from 'vitest';
import { listedFiles } from '../../../../src/ui/editors/outliner/files-list.ts';
import { character, documentOf } from '../../../helpers/builders.ts';

it('a file that several characters came from is listed once', () => {
  const source = (path: string) => ({ ...character().sources[0], name: path, path, bytes: 10 });
  const two = ['left', 'right'].map((id) => character({ id, name: id, sources: [source('two dancers.bvh')] }));
  const other = character({ id: 'other', sources: [source('other.skel')] });
  expect(listedFiles(documentOf(...two, other)).map((file) => file.source.name)).toEqual([
    'two dancers.bvh',
    'other.skel',
  ]);
});
