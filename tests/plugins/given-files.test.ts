import { mkdirSync, mkdtempSync, realpathSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { queryOf, tableOf } from '../../plugins/given-files.ts';
import { findGiven } from '../../src/cli/paths.ts';
import { filesInQuery } from '../../src/io/address.ts';

let folder = '';
beforeAll(() => {
  folder = realpathSync(mkdtempSync(join(tmpdir(), 'marrow-')));
  for (const sub of ['one', 'a b,c%d']) {
    mkdirSync(join(folder, sub));
    writeFileSync(join(folder, sub, 'wasp.skel'), '');
  }
  writeFileSync(join(folder, 'one', 'x,y 50%#?&+ä.skin'), '');
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const given = (...args: string[]) => findGiven(args, folder);

describe('files given to npm start', () => {
  it('files given to npm start are separated by folder, and kept together within one', () => {
    const table = tableOf(given('one/wasp.skel', 'a b,c%d/wasp.skel', 'one/x,y 50%#?&+ä.skin').files);
    expect([...table.keys()]).toEqual(['/given/0/wasp.skel', '/given/1/wasp.skel', '/given/0/x,y 50%#?&+ä.skin']);
    expect(table.get('/given/1/wasp.skel')).toBe(join(folder, 'a b,c%d', 'wasp.skel'));
  });

  it('files given to npm start are named in the address so that the page reads the same names back', () => {
    const table = tableOf(given('one', 'a b,c%d').files);
    expect(filesInQuery(queryOf(table))).toEqual([...table.keys()].map((address) => address.slice(1)));
  });

  it('files given to npm start are relative to the caller, each once; missing ones are named as written', () => {
    const { files, missing } = given('one', './one/wasp.skel', 'one/none.skel', join(folder, 'one', 'wasp.skel'));
    expect(files.map((f) => f.path)).toEqual(['one/wasp.skel', 'one/x,y 50%#?&+ä.skin']);
    const why = `There is no such file in ${folder}.`;
    expect(missing).toEqual([{ path: 'one/none.skel', code: 'file-missing', why }]);
  });
});
