/** What the command does with files of points. */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, it } from 'vitest';
import { readNpz } from '../../dataset/read-npz.ts';
import { c3dOf, type PointFrame } from '../../helpers/c3d.ts';
import { command } from '../../helpers/command.ts';

const folder = mkdtempSync(join(tmpdir(), 'marrow-points-'));
afterAll(() => rmSync(folder, { recursive: true }));

const FRAMES: readonly PointFrame[] = [
  [[1.5, 1000, 3], null],
  [
    [2, 1001, 3],
    [4, 500, -6.25],
  ],
  [[3, 1002, 3], null],
];
const PARTS = ['shoulder', 'elbow', 'wrist', 'hip', 'knee', 'ankle'];
const COCO = [
  ...['nose', 'left_eye', 'right_eye', 'left_ear', 'right_ear'],
  ...PARTS.flatMap((part) => [`left_${part}`, `right_${part}`]),
];
const person = (frame: number): PointFrame =>
  COCO.map((_, p) => [0.1 * (p % 2) + 0.01 * frame, 2 - 0.1 * p, 0.05 * (p % 3)]);

writeFileSync(join(folder, 'walk.c3d'), c3dOf({ labels: ['LASI', 'Left knee'], frames: FRAMES }));
writeFileSync(join(folder, 'person.c3d'), c3dOf({ labels: COCO, frames: [person(0), person(1)], unit: 'm' }));
writeFileSync(join(folder, 'rows.csv'), 'time,a.x,a.y,a.z\n0,1,2,3\n0.5,2,2,3\n');
writeFileSync(join(folder, 'arm.skel'), 'balljoint a { offset 1 2 3 }');

const run = async (...args: readonly string[]) => {
  const { code, out, err } = await command(args, folder);
  return { code, out, err };
};

describe('points on the command line', () => {
  it('are posed in the unit and axes of their file, without joints, and null where they are missing', async () => {
    const { out, code } = await run('pose', 'walk.c3d', '--frame', '1', '--json');
    const [character] = JSON.parse(out).characters;
    expect(code).toBe(0);
    expect(character.joints).toEqual([]);
    expect(character.points).toEqual([
      { name: 'LASI', position: [2, 1001, 3] },
      { name: 'Left knee', position: [4, 500, -6.25] },
    ]);
    const later = JSON.parse((await run('pose', 'walk.c3d', '--time', '0.02', '--json')).out).characters[0];
    expect(later.points[1]).toEqual({ name: 'Left knee', position: null });
    expect(later.bounds).toEqual({ min: [3, 1002, 3], max: [3, 1002, 3] });
    expect((await run('pose', 'walk.c3d')).out).toContain('Left knee: missing');
  });

  it('are counted apart from joints, with frames and their time', async () => {
    const { files, characters } = JSON.parse((await run('info', 'walk.c3d', '--json')).out);
    expect(files[0]).toMatchObject({ loaded: true, joints: 0, points: 2, frames: 3, frameTime: 0.01 });
    expect(characters[0]).toMatchObject({ joints: 0, points: 2 });
  });

  it.each(['bvh', 'skel', 'anim', 'asf', 'glb', 'fbx', 'vrma'])(
    'without bones are no .%s, which is said',
    async (to) => {
      const { code, err } = await run('convert', 'walk.c3d', `walk.${to}`);
      expect(code).toBe(1);
      expect(err).toMatch(/points without bones/);
    },
  );

  it('without bones are left out where many files are converted, which is said', async () => {
    const { code, err } = await run('convert', 'walk.c3d', 'person.c3d', '--to', 'bvh', '--out', 'many');
    expect(code).toBe(1);
    expect(err).toMatch(/walk\.c3d.*points without bones/);
    expect(readFileSync(join(folder, 'many/person.bvh'), 'utf8')).toContain('ROOT pelvis');
  });

  it('are converted many at once, cropped too; what has bones is left out, which is said', async () => {
    const { code, err } = await run('convert', 'walk.c3d', 'rows.csv', 'person.c3d', '--to', 'trc', '--out', 'points');
    expect(code).toBe(1);
    expect(err).toMatch(/person\.c3d.*has no points/);
    expect(await run('convert', 'walk.c3d', 'points/one.trc')).toMatchObject({ code: 0 });
    const rows = (name: string) => readFileSync(join(folder, name), 'utf8').split('\n').slice(1);
    expect(rows('points/walk.trc')).toEqual(rows('points/one.trc'));
    expect(rows('points/rows.trc')[1]).toMatch(/^2\t2\t2\t1\t/);
    const cropped = ['--to', 'trc', '--crop', '0.01,0.02', '--out', 'cropped'];
    expect(await run('convert', 'walk.c3d', ...cropped)).toMatchObject({ code: 0 });
    expect(rows('cropped/walk.trc')[5]).toBe('1\t0\t2\t1001\t3\t4\t500\t-6.25');
    const failed = await run('convert', 'walk.c3d', '--to', 'bvh', '--crop', '0,1', '--out', 'cropped');
    expect([failed.code, failed.err]).toEqual([1, expect.stringMatching(/points without bones/)]);
  });

  it('of a person are converted as any capture', async () => {
    for (const to of ['bvh', 'glb', 'anim', 'fbx']) {
      expect(await run('convert', 'person.c3d', `person.${to}`)).toMatchObject({ code: 0 });
    }
    expect(readFileSync(join(folder, 'person.bvh'), 'utf8')).toContain('JOINT left_shoulder');
  });

  it('are written as .trc, read the same again, and written the same once more', async () => {
    expect(await run('convert', 'walk.c3d', 'walk.trc')).toMatchObject({ code: 0 });
    const text = readFileSync(join(folder, 'walk.trc'), 'utf8');
    expect(text).toContain('\tmm\t');
    expect(text).toContain('\n1\t0\t1.5\t1000\t3\t\t\t\n2\t0.01\t2\t1001\t3\t4\t500\t-6.25\n');
    const posed = async (file: string) =>
      JSON.parse((await run('pose', file, '--frame', '1', '--json')).out).characters[0].points;
    expect(await posed('walk.trc')).toEqual(await posed('walk.c3d'));
    expect(await run('convert', 'walk.trc', 'again.trc')).toMatchObject({ code: 0 });
    expect(readFileSync(join(folder, 'again.trc'), 'utf8')).toBe(text.replace('walk.trc', 'again.trc'));
    expect(await run('convert', 'walk.trc', 'cut.trc', '--crop', '0.01,0.02')).toMatchObject({ code: 0 });
    expect(readFileSync(join(folder, 'cut.trc'), 'utf8')).toContain(
      '\n1\t0\t2\t1001\t3\t4\t500\t-6.25\n2\t0.01\t3\t1002\t3\t\t\t\n',
    );
  });

  it('are exported as arrays, with no number where one is missing', async () => {
    const { code, err } = await run('export', 'walk.c3d', 'rows.csv', '--to', 'npz', '--out', 'arrays', '--raw');
    expect(err.match(/^1 take: .*$/gm)).toHaveLength(2);
    expect(code).toBe(0);
    const { names, positions } = readNpz(readFileSync(join(folder, 'arrays/walk.npz')));
    expect(names.values).toEqual(['LASI', 'Left knee']);
    expect(Array.from<number | string>(positions.values).slice(6, 12)).toEqual([2, 1001, 3, 4, 500, -6.25]);
    expect(Array.from<number | string>(positions.values).slice(3, 6)).toEqual([Number.NaN, Number.NaN, Number.NaN]);
    expect(readNpz(readFileSync(join(folder, 'arrays/rows.npz'))).names.values).toEqual(['a']);
  });

  it('in a table that is given to compare are numbers to compare', async () => {
    const { out } = await run('compare', 'arm.skel', 'rows.csv', '--json');
    expect(out).not.toContain('dump-missing');
  });
});
