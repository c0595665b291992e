/** `marrow convert`, of takes that are cropped, mirrored or retargeted. */
import { existsSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { command } from '../helpers/command.ts';
import { makeTakes, WALK } from './captures.ts';

let folder = '';
beforeEach(() => {
  folder = makeTakes();
});
afterEach(() => rmSync(folder, { recursive: true, force: true }));

const filesIn = (name: string) =>
  readdirSync(join(folder, name), { recursive: true, encoding: 'utf8' })
    .filter((file) => /\.\w+$/.test(file))
    .sort();

describe('marrow convert, of edited takes', () => {
  const converted = (...args: string[]) => command(['convert', ...args], folder);
  const motion = (name: string) =>
    readFileSync(join(folder, name), 'utf8').split('MOTION')[1].trim().split('\n').slice(2);

  it('marrow convert --crop keeps the frames of the times meant, with the numbers of the file', async () => {
    const { code, err } = await converted('takes/walk.bvh', 'out.bvh', '--crop', '0.2,0.41');
    expect([code, err]).toEqual([0, '']);
    expect(motion('out.bvh').map((row) => row.split(' ').map(Number))).toEqual(
      [2, 3, 4].map((f) => [10 * f, 90, 0, 0, 0, 0, 0, 6 * f, 0]),
    );
    const gone = await converted('takes/walk.bvh', 'none.bvh', '--crop', '5,6');
    expect([gone.code, gone.err]).toEqual([
      1,
      expect.stringContaining('Nothing is left after cropping: the take is from 0 s to 1 s.'),
    ]);
    expect(existsSync(join(folder, 'none.bvh'))).toBe(false);
  });

  it('a take retargeted to its own skeleton is itself', async () => {
    const { code, err } = await converted('takes/walk.bvh', '--retarget', 'takes/b/walk.bvh', 'out.bvh');
    expect([code, err]).toEqual([0, '']);
    motion('out.bvh').forEach((row, f) => {
      const expected = [10 * f, 90, 0, 0, 0, 0, 0, 6 * f, 0];
      row.split(' ').forEach((value, c) => void expect(Number(value)).toBeCloseTo(expected[c], 4));
    });
  });

  it('a retargeted take has the joints of its target, in any format', async () => {
    writeFileSync(join(folder, 'small.bvh'), WALK.replaceAll('Arm', 'Limb').replace('OFFSET 0 10 0', 'OFFSET 0 5 0'));
    writeFileSync(join(folder, 'map.csv'), 'Hips,Hips\nLimb,Arm\n');
    const args = ['takes/walk.bvh', '--retarget', 'small.bvh', '--map', 'map.csv'];
    expect(await converted(...args, 'out.bvh')).toMatchObject({ code: 0, err: '' });
    const text = readFileSync(join(folder, 'out.bvh'), 'utf8');
    expect(text).toMatch(/JOINT Limb\s*\{\s*OFFSET 0 5 0/);
    expect(motion('out.bvh')).toHaveLength(11);
    expect(await converted(...args, 'out.skel')).toMatchObject({ code: 0, err: '' });
    expect(readFileSync(join(folder, 'out.skel'), 'utf8')).toContain('Limb');
  });

  it('with --to they are shared among threads and parts as exports are, with a manifest', async () => {
    const args = ['takes', '--to', 'bvh', '--out', 'out', '--mirror', '--resume'];
    const { code, out } = await converted(...args);
    expect([code, out]).toEqual([0, expect.stringMatching(/^out: 4 takes exported/)]);
    expect(filesIn('out')).toEqual(['b/walk.bvh', 'manifest.ndjson', 'two.1.bvh', 'two.2.bvh', 'walk.bvh']);
    expect((await converted(...args)).out).toBe('out: nothing to do: 4 takes already exported\n');
    expect((await converted('takes', '--to', 'skel', '--out', 'keys', '--crop', ',0.5')).code).toBe(0);
    expect(filesIn('keys').slice(0, 2)).toEqual(['b/walk.anim', 'b/walk.skel']);
  });

  it('what belongs to many files is refused for one', async () => {
    expect((await converted('takes/walk.bvh', 'out.bvh', '--resume')).err).toMatch('--resume needs --to');
    expect((await converted('takes', '--to', 'bvh', '--mirror')).err).toMatch('--out is missing');
  });
});
