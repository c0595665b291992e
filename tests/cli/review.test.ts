/** `marrow review`: takes as a list, which the command and the page read back. */
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { readList } from '../../src/review/read-list.ts';
import { command } from '../helpers/command.ts';
import { describeShared, sharedPath } from '../helpers/shared.ts';

describeShared('marrow review', () => {
  const folder = sharedPath('data/bvh/');

  it('lists takes with their frames, rate, joints and flags', async () => {
    const { code, out } = await command(['review', 'openni-kinect-hash-names.bvh', 'xsens-armchair.bvh'], folder);
    expect(code).toBe(0);
    const [kinect, chair] = readList(out, 'list.csv').takes;
    expect([kinect.path, kinect.frames, kinect.fps, kinect.joints]).toEqual([
      'openni-kinect-hash-names.bvh',
      300,
      30,
      20,
    ]);
    expect(kinect.flags?.some((flag) => flag.startsWith('jitter'))).toBe(true);
    expect([chair.frames, chair.flags]).toEqual([200, undefined]);
  });

  it('keeps the verdicts of a list, and says which file is missing', async () => {
    const own = mkdtempSync(join(tmpdir(), 'marrow-review-'));
    writeFileSync(
      join(own, 'before.csv'),
      'path,verdict,stars,tags,notes\nlab/bvh/xsens-armchair.bvh,bad,2,sits; calm,"no, really"\n',
    );
    const args = [
      'review',
      sharedPath('data/bvh/xsens-armchair.bvh'),
      'gone.bvh',
      '--list',
      'before.csv',
      '--out',
      'list.json',
    ];
    const { code, out, err } = await command(args, own);
    expect([code, out]).toEqual([1, '']);
    expect(err).toContain('gone.bvh');
    // Of the list's path only the end is that of the file.
    expect(readList(readFileSync(join(own, 'list.json'), 'utf8'), 'list.json').takes).toMatchObject([{ verdict: '' }]);
    writeFileSync(
      join(own, 'before.csv'),
      'path,verdict,stars,tags,notes\nbvh/xsens-armchair.bvh,bad,2,sits; calm,"no, really"\n',
    );
    await command(args, own);
    expect(readList(readFileSync(join(own, 'list.json'), 'utf8'), 'list.json').takes).toMatchObject([
      { verdict: 'bad', stars: 2, tags: ['sits', 'calm'], notes: 'no, really' },
    ]);
  });
});

describe('marrow review without takes', () => {
  it.each([
    [[], 'Give at least one file'],
    [['.', '--out', 'list.txt'], 'ends in .csv or .json'],
    [['.', '--list', 'nowhere.csv'], '--list: nowhere.csv could not be read: there is no such file'],
  ])('with %j is wrong usage', async (args, message) => {
    const { code, err } = await command(['review', ...args], mkdtempSync(join(tmpdir(), 'marrow-review-')));
    expect([code, err]).toEqual([2, expect.stringContaining(message)]);
  });

  it('of an empty folder says so', async () => {
    const { code, err } = await command(['review', '.'], mkdtempSync(join(tmpdir(), 'marrow-review-')));
    expect([code, err]).toEqual([1, expect.stringContaining('no takes here')]);
  });
});
