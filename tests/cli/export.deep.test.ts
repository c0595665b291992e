/** `marrow export`. Threads and processes are tested with the built command. */
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { strToU8, zipSync } from 'fflate';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { readNpz } from '../dataset/read-npz.ts';
import { command } from '../helpers/command.ts';
import { npzOf } from '../helpers/numpy.ts';
import { describeShared, sharedPath } from '../helpers/shared.ts';
import { bvh, makeTakes, WALK } from './captures.ts';

const ASF = `:version 1.10
:name one
:units
  length 0.45
  angle deg
:root
  order TX TY TZ RX RY RZ
  axis XYZ
  position 0 0 0
  orientation 0 0 0
:bonedata
  begin
    id 1
    name arm
    direction 0 1 0
    length 2
    axis 0 0 0 XYZ
    dof rz
  end
:hierarchy
  begin
    root arm
  end
`;
const AMC = `:FULLY-SPECIFIED\n:DEGREES\n${[1, 2, 3].map((f) => `${f}\nroot ${f} 20 0 0 0 0\narm ${10 * f}\n`).join('')}`;

let folder = '';
beforeEach(() => {
  folder = makeTakes();
});
afterEach(() => rmSync(folder, { recursive: true, force: true }));

const exported = (...args: string[]) => command(['export', ...args], folder);
const manifest = (name = 'out/manifest.ndjson') =>
  readFileSync(join(folder, name), 'utf8')
    .trimEnd()
    .split('\n')
    .map((line): Record<string, unknown> => JSON.parse(line));
const npz = (name: string) => readNpz(readFileSync(join(folder, name)));
const filesIn = (name: string) =>
  readdirSync(join(folder, name), { recursive: true, encoding: 'utf8' })
    .filter((file) => /\.\w+$/.test(file))
    .sort();
const meta = (name: string): Record<string, unknown> => JSON.parse(String(npz(name).meta.values[0]));

describe('marrow export', () => {
  it('the shape of a body is no take: it is skipped, told and fails nothing but a command that has only such', async () => {
    const shape = npzOf({ betas: [[16], new Float64Array(16)], v_template: [[2, 3], new Float64Array(6)] });
    writeFileSync(join(folder, 'takes', 'walk_stagei.npz'), shape);
    const { code, out, err } = await exported('takes', '--to', 'npz', '--out', 'out');
    expect([code, out]).toEqual([0, expect.stringMatching(/^out: 4 takes exported, [\d.]+ MB\n$/)]);
    expect(err).toMatch(
      /^1 file skipped \(takes\/walk_stagei.npz\): It has the shape of a body \(betas\) without motion/,
    );
    expect(manifest()).toHaveLength(4);
    const listed = await command(['review', 'takes'], folder);
    expect([listed.code, listed.err]).toEqual([0, expect.stringContaining('(skipped)')]);
    const alone = ['takes/walk_stagei.npz'];
    expect((await exported(...alone, '--to', 'npz', '--out', 'none')).code).toBe(1);
    expect((await command(['info', ...alone], folder)).code).toBe(1);
    expect((await command(['convert', ...alone, 'x.bvh'], folder)).code).toBe(1);
  });

  it.each([['--no-times'], ['--raw'], ['--float64']])(
    'points that were exported are points again, missing where they were: %s',
    async (...how) => {
      const rows = ['frame,A.x,A.y,A.z,B.x,B.y,B.z', '0,,,,0,1.5,0.25', '1,0.5,0,1,,,', '2,0.5,0.25,1,0,1.75,0.5'];
      writeFileSync(join(folder, 'p.csv'), rows.join('\n'));
      await exported('p.csv', '--to', 'npz', '--out', 'once', ...how);
      const { code, err } = await exported('once', '--to', 'npz', '--out', 'twice', ...how);
      expect([code, err]).toEqual([0, '']);
      const { meta: _, ...once } = npz('once/p.npz');
      expect(once.positions.values.filter(Number.isNaN)).toHaveLength(6);
      expect(npz('twice/p.npz')).toMatchObject(once);
    },
  );

  it('marrow export writes each take at its path below the folder that was named, and a manifest', async () => {
    const { code, out, err } = await exported('takes', '--to', 'npz', '--out', 'out');
    expect([code, err]).toEqual([0, '']);
    expect(out).toMatch(/^out: 4 takes exported, 0\.0 MB\n$/);
    expect(filesIn('out')).toEqual(['b/walk.npz', 'manifest.ndjson', 'two.1.npz', 'two.2.npz', 'walk.npz']);
    expect(
      manifest().map(({ input, output, frames, fps, joints, flags }) => [input, output, frames, fps, joints, flags]),
    ).toEqual([
      ['takes/b/walk.bvh', 'b/walk.npz', 11, 10, 2, []],
      ['takes/two.bvh', 'two.1.npz', 2, 10, 2, []],
      ['takes/two.bvh', 'two.2.npz', 2, 10, 1, []],
      ['takes/walk.bvh', 'walk.npz', 11, 10, 2, []],
    ]);
    expect(manifest()[3].hash).toMatch(/^[0-9a-f]{64}$/);
    const walk = npz('out/walk.npz');
    expect(walk.names.values).toEqual(['Hips', 'Arm']);
    expect(walk.parents.values).toEqual([-1, 0]);
    expect(walk.end_names.values).toEqual(['Arm_end']);
    expect([walk.positions.descr, walk.positions.shape]).toEqual(['<f4', [11, 2, 3]]);
    expect(walk.local_6d.shape).toEqual([11, 2, 6]);
    expect(meta('out/walk.npz')).toMatchObject({
      input: 'takes/walk.bvh',
      hash: manifest()[3].hash,
      unit: 'metre',
      up: 'y',
    });
  });

  it('a take with layers is the plain file beside them: its base and layers are no takes of their own', async () => {
    const keys = (value: number) =>
      `animation {\n range 0 1\n numchannels 6\n${`channel {\n extrapolate constant constant\n keys 1 {\n 0 ${value} flat flat\n }\n}\n`.repeat(6)}}\n`;
    writeFileSync(join(folder, 'takes/a.skel'), 'balljoint root {\n balljoint arm {\n  offset 0 1 0\n }\n}\n');
    const layers = {
      base: 'wave.base.anim',
      layers: [{ name: 'up', file: 'wave.up.anim', mode: 'additive', weight: 1 }],
    };
    for (const [name, text] of [
      ['wave.anim', keys(0.5)],
      ['wave.base.anim', keys(0)],
      ['wave.up.anim', keys(0.5)],
      ['wave.layers.json', JSON.stringify(layers)],
    ]) {
      writeFileSync(join(folder, 'takes', name), text);
    }
    const inputs = async () => {
      await exported('takes', '--to', 'npz', '--out', 'out');
      return manifest().flatMap(({ input }) => (/wave/.test(String(input)) ? [input] : []));
    };
    expect(await inputs()).toEqual(['takes/wave.anim']);
    rmSync(join(folder, 'takes/wave.anim'));
    rmSync(join(folder, 'out'), { recursive: true });
    expect(await inputs()).toEqual(['takes/wave.base.anim', 'takes/wave.up.anim']);
  });

  it('raw numbers are those of the file, in double precision if asked', async () => {
    await exported('takes/walk.bvh', '--to', 'npz', '--out', 'out', '--raw', '--float64');
    const { positions, end_positions, velocities, times, fps } = npz('out/takes/walk.npz');
    expect(positions.descr).toBe('<f8');
    expect(positions.values.slice(0, 12)).toEqual([0, 90, 0, 0, 100, 0, 10, 90, 0, 10, 100, 0]);
    expect(end_positions.values.slice(0, 3)).toEqual([0, 105, 0]);
    expect(velocities.values.slice(0, 3)).toEqual([100, 0, 0]);
    expect([fps.values, times.values.slice(0, 3)]).toEqual([[10], [0, 0.1, 0.2]]);
    expect(meta('out/takes/walk.npz')).toMatchObject({ raw: true, unit: null, up: null });
  });

  it('a second export with --resume does nothing and says so, and does again what changed', async () => {
    await exported('takes', '--to', 'npz', '--out', 'out');
    const before = readFileSync(join(folder, 'out/manifest.ndjson'), 'utf8');
    const again = await exported('takes', '--to', 'npz', '--out', 'out', '--resume');
    expect(again).toEqual({ code: 0, out: 'out: nothing to do: 4 takes already exported\n', err: '' });
    expect(readFileSync(join(folder, 'out/manifest.ndjson'), 'utf8')).toBe(before);
    writeFileSync(join(folder, 'takes/walk.bvh'), `${WALK}\n`);
    expect((await exported('takes', '--to', 'npz', '--out', 'out', '--resume')).out).toMatch(
      /1 take exported.*3 unchanged/,
    );
    expect((await exported('takes', '--to', 'npz', '--out', 'out', '--resume', '--fps', '5')).out).toMatch(
      /4 takes exp/,
    );
    expect(npz('out/walk.npz').positions.shape).toEqual([6, 2, 3]);
    rmSync(join(folder, 'out/walk.npz'));
    expect((await exported('takes', '--to', 'npz', '--out', 'out', '--resume', '--fps', '5')).out).toMatch(
      /1 take exp/,
    );
  });

  it('a second export with --resume makes a .gltf anew whose buffer has changed or is gone', async () => {
    const buffer = (z: number) =>
      new Uint8Array(Float32Array.of(0, 1, 0, 0, 0, 1, 0, 0, z, Math.sqrt(1 - z * z)).buffer);
    const accessor = (byteOffset: number, count: number, type: string) => ({
      ...{ bufferView: 0, byteOffset, componentType: 5126, count, type },
      ...(type === 'SCALAR' && { min: [0], max: [1] }),
    });
    const gltf = {
      asset: { version: '2.0' },
      scene: 0,
      scenes: [{ nodes: [0] }],
      nodes: [
        { name: 'Hips', children: [1] },
        { name: 'Arm', translation: [0, 1, 0] },
      ],
      animations: [
        { channels: [{ sampler: 0, target: { node: 1, path: 'rotation' } }], samplers: [{ input: 0, output: 1 }] },
      ],
      accessors: [accessor(0, 2, 'SCALAR'), accessor(8, 2, 'VEC4')],
      bufferViews: [{ buffer: 0, byteOffset: 0, byteLength: 40 }],
      buffers: [{ uri: 'wave.bin', byteLength: 40 }],
    };
    mkdirSync(join(folder, 'waves'));
    writeFileSync(join(folder, 'waves/wave.gltf'), JSON.stringify(gltf));
    writeFileSync(join(folder, 'waves/wave.bin'), buffer(0.5));
    const args = ['waves', '--to', 'npz', '--out', 'out', '--float64', '--resume'];
    expect(await exported(...args)).toMatchObject({ code: 0, err: '' });
    const last = () => npz('out/wave.npz').local_quat.values.at(-2);
    expect(last()).toBeCloseTo(0.5, 6);
    expect(manifest()[0].beside).toEqual([{ path: 'waves/wave.bin', hash: expect.stringMatching(/^[0-9a-f]{64}$/) }]);
    expect((await exported(...args)).out).toBe('out: nothing to do: 1 take already exported\n');
    writeFileSync(join(folder, 'waves/wave.bin'), buffer(0.25));
    expect((await exported(...args)).out).toMatch(/^out: 1 take exported/);
    expect(last()).toBeCloseTo(0.25, 6);
    rmSync(join(folder, 'waves/wave.bin'));
    const gone = await exported(...args);
    expect([gone.code, gone.err]).toEqual([1, expect.stringContaining('wave.bin')]);
    // As in a zip, of which another has a file of that name.
    const zip = (name: string, z?: number) => {
      const files: Record<string, Uint8Array> = z === undefined ? {} : { 'wave.bin': buffer(z) };
      writeFileSync(join(folder, name), zipSync({ 'wave.gltf': strToU8(JSON.stringify(gltf)), ...files }));
    };
    zip('a.zip', 0.5);
    zip('b.zip', 0.25);
    const packed = ['a.zip', 'b.zip', '--to', 'npz', '--out', 'packed', '--float64', '--resume'];
    expect(await exported(...packed)).toMatchObject({ code: 0, err: '' });
    for (const [name, z] of [
      ['a', 0.5],
      ['b', 0.25],
    ] as const) {
      expect(npz(`packed/${name}/wave.npz`).local_quat.values.at(-2)).toBeCloseTo(z, 6);
    }
    expect((await exported(...packed)).out).toContain('nothing to do');
    zip('a.zip', 0.25);
    expect((await exported(...packed)).out).toContain('1 take exported');
    expect((await command(['review', 'a.zip', 'b.zip'], folder)).code).toBe(0);
    zip('a.zip');
    const without = await exported(...packed);
    expect([without.code, without.err]).toEqual([1, expect.stringContaining('wave.bin')]);
  });

  it('files that exist are kept without --resume or --force, with their manifest, and told in words', async () => {
    await exported('takes', '--to', 'npz', '--out', 'out');
    const before = manifest();
    const { code, err } = await exported('takes', '--to', 'npz', '--out', 'out', '--fps', '5');
    expect(code).toBe(1);
    expect(err).toContain('walk.npz already exists. Use --resume to continue an export, --force to overwrite.');
    expect(manifest()).toEqual(before);
    for (const part of ['1/2', '2/2']) await exported('takes', '--to', 'npz', '--out', 'out', '--shard', part);
    expect(manifest()).toEqual(before);
    // What others add is listed beside.
    writeFileSync(join(folder, 'more.bvh'), WALK);
    expect((await exported('more.bvh', '--to', 'npz', '--out', 'out')).code).toBe(0);
    expect(manifest()).toEqual([expect.objectContaining({ output: 'more.npz' }), ...before]);
    expect(npz('out/walk.npz').positions.shape).toEqual([11, 2, 3]);
    expect((await exported('takes', '--to', 'npz', '--out', 'out', '--fps', '5', '--force')).code).toBe(0);
    expect(npz('out/walk.npz').positions.shape).toEqual([6, 2, 3]);
  });

  it('parts give the same files and the same manifest as all at once', async () => {
    await exported('takes', '--to', 'npz', '--out', 'out', '--no-times');
    for (const part of ['3/3', '1/3', '2/3']) {
      const { code, out } = await exported('takes', '--to', 'npz', '--out', 'parts', '--no-times', '--shard', part);
      expect([code, out]).toEqual([0, expect.stringContaining(`parts: part ${part.replace('/', ' of ')}: `)]);
      expect(existsSync(join(folder, 'parts/manifest.ndjson'))).toBe(part === '2/3');
    }
    for (const name of filesIn('out')) {
      expect(readFileSync(join(folder, 'parts', name)).equals(readFileSync(join(folder, 'out', name)))).toBe(true);
    }
    const parts = ['1', '2', '3'].map((i) => readFileSync(join(folder, `parts/manifest.${i}-of-3.ndjson`), 'utf8'));
    expect(parts.join('').split('\n').sort().join('\n').trim()).toBe(
      readFileSync(join(folder, 'out/manifest.ndjson'), 'utf8').trim(),
    );
    expect((await exported('takes', '--to', 'npz', '--out', 'parts', '--resume')).out).toMatch(/nothing to do: 4/);
    expect(filesIn('parts')).toEqual(filesIn('out'));
  });

  it('takes that fail are listed, in the manifest too, and the others are exported', async () => {
    writeFileSync(join(folder, 'takes/broken.bvh'), WALK.replace('OFFSET 0 10 0', 'OFFSET 0 1o 0'));
    writeFileSync(join(folder, 'takes/still.bvh'), bvh('Hips', []));
    const { code, out, err } = await exported('takes', 'gone.bvh', '--to', 'npz', '--out', 'out');
    expect(code).toBe(1);
    expect(out).toMatch(/4 takes exported.*3 failed/);
    expect(err.split('\n')).toEqual([
      'gone.bvh: There is no file of this name.',
      expect.stringMatching(/^takes\/broken\.bvh: Line 5: Expected y of OFFSET, found "1o"/),
      'takes/still.bvh: It has no motion: no frames and no keys.',
      '',
    ]);
    expect(
      manifest()
        .filter(({ error }) => error !== undefined)
        .map(({ input }) => input),
    ).toEqual(['gone.bvh', 'takes/broken.bvh', 'takes/still.bvh']);
    expect(filesIn('out').filter((file) => /broken|still|tmp/.test(file))).toEqual([]);
  });

  it('an animation is exported with its skeleton', async () => {
    mkdirSync(join(folder, 'hero'));
    writeFileSync(join(folder, 'hero/hero.skel'), 'balljoint root { offset 0 1 0 balljoint arm { offset 0 2 0 } }');
    const channel = (keys: string) => `channel { extrapolate constant constant keys ${keys} }`;
    const still = channel('1 { 0 0 flat flat }');
    const channels = [
      still,
      channel('2 { 0 0 linear linear 1 4 linear linear }'),
      ...Array.from({ length: 7 }, () => still),
    ];
    writeFileSync(join(folder, 'hero/hero_jump.anim'), `animation { range 0 1 numchannels 9 ${channels.join(' ')} }`);
    const { code, err } = await exported('hero', '--to', 'npz', '--out', 'out', '--float64');
    expect([code, err]).toEqual([0, '']);
    expect(filesIn('out')).toEqual(['hero_jump.npz', 'manifest.ndjson']);
    const { positions, fps } = npz('out/hero_jump.npz');
    expect([fps.values, positions.shape]).toEqual([[60], [61, 2, 3]]);
    expect(positions.values.slice(6 * 30, 6 * 31)).toEqual([0, 3, 0, 0, 5, 0]);
    expect(meta('out/hero_jump.npz')).toMatchObject({ input: 'hero/hero_jump.anim', skeleton: 'hero/hero.skel' });
  });

  it('inputs that differ in their endings only keep these in their outputs', async () => {
    writeFileSync(join(folder, 'takes/two.1.bvh'), WALK);
    await exported('takes', '--to', 'npz', '--out', 'out');
    expect(filesIn('out')).toEqual([
      'b/walk.npz',
      'manifest.ndjson',
      'two.1.bvh.npz',
      'two.1.npz',
      'two.2.npz',
      'walk.npz',
    ]);
    const { code, err } = await exported('takes', 'takes/b', '--to', 'npz', '--out', 'out2');
    expect([code, err]).toEqual([0, '']);
    mkdirSync(join(folder, 'other'));
    for (const name of ['walk.bvh', 'walk.bvh.bvh', 'walk.skel', 'walk.anim']) {
      writeFileSync(join(folder, 'other', name), WALK);
    }
    const clash = await exported('other', '--to', 'npz', '--out', 'out3');
    expect(clash.code).toBe(2);
    expect(clash.err).toContain('other/walk.bvh and other/walk.bvh.bvh would have the same output, walk.bvh');
    expect(existsSync(join(folder, 'out3'))).toBe(false);
  });

  it('where takes of two named folders have equal paths, all are placed below the folder that they share', async () => {
    mkdirSync(join(folder, 'other/b'), { recursive: true });
    writeFileSync(join(folder, 'other/b/run.bvh'), WALK);
    const apart = await exported('takes', 'other', '--to', 'npz', '--out', 'out');
    expect([apart.code, filesIn('out')]).toEqual([
      0,
      ['b/run.npz', 'b/walk.npz', 'manifest.ndjson', 'two.1.npz', 'two.2.npz', 'walk.npz'],
    ]);
    writeFileSync(join(folder, 'other/b/walk.bvh'), WALK);
    const equal = ['other/b/run.npz', 'other/b/walk.npz', 'takes/b/walk.npz', 'takes/two.1.npz', 'takes/two.2.npz'];
    for (const [out, ...parts] of [['whole'], ['parts', '--shard', '1/2'], ['parts', '--shard', '2/2']]) {
      const { code, err } = await exported('takes', 'other', '--to', 'npz', '--out', out, '--no-times', ...parts);
      expect([code, err]).toEqual([0, '']);
    }
    expect(filesIn('whole')).toEqual(['manifest.ndjson', ...equal, 'takes/walk.npz']);
    for (const name of filesIn('whole')) {
      expect(readFileSync(join(folder, 'parts', name)).equals(readFileSync(join(folder, 'whole', name)))).toBe(true);
    }
    // The same takes belong elsewhere now; what is at the old places is told.
    const again = await exported('takes', 'other', '--to', 'npz', '--out', 'out', '--resume');
    expect(again.out).toMatch(/^out: 6 takes exported/);
    expect(again.err).toMatch(
      /^marrow: 5 outputs from earlier runs are no longer listed.*: b\/run\.npz, b\/walk\.npz, two/,
    );
  });

  it('files outside the folder where it is called keep equal names apart by the folder that they share', async () => {
    mkdirSync(join(folder, 'desk'));
    const from = (paths: readonly string[], out: string) =>
      command(['export', ...paths, '--to', 'npz', '--out', out], join(folder, 'desk'));
    const inputs = ['../takes/walk.bvh', '../takes/b/walk.bvh'];
    expect((await from(inputs, 'both')).code).toBe(0);
    expect(filesIn('desk/both')).toEqual(['b/walk.npz', 'manifest.ndjson', 'walk.npz']);
    expect((await from([join(folder, 'takes/b/walk.bvh')], 'one')).code).toBe(0);
    expect(filesIn('desk/one')).toEqual(['manifest.ndjson', 'walk.npz']);
  });

  it('an output folder that is a file, or below one, is wrong usage', async () => {
    for (const out of ['takes/walk.bvh', 'takes/walk.bvh/below']) {
      const { code, err } = await exported('takes', '--to', 'npz', '--out', out);
      expect(code).toBe(2);
      expect(err).toContain(`marrow: --out takes a folder; ${out} is not one and could not be created: `);
    }
  });

  it('each character of a file retargeted onto that file is itself', async () => {
    for (const [out, ...args] of [['as-read'], ['onto-itself', '--retarget', 'takes/two.bvh']]) {
      const { code, err } = await exported('takes/two.bvh', '--to', 'npz', '--out', out, '--float64', ...args);
      expect([code, err]).toEqual([0, '']);
    }
    for (const name of ['two.1.npz', 'two.2.npz']) {
      const [read, onto] = [npz(`as-read/takes/${name}`), npz(`onto-itself/takes/${name}`)];
      expect(onto.names.values).toEqual(read.names.values);
      for (const [i, value] of read.positions.values.entries()) {
        expect(onto.positions.values[i]).toBeCloseTo(Number(value), 9);
      }
    }
  });

  it('of several characters to retarget to, in several files or with other joints than the take, it takes none', async () => {
    const onto = (...targets: string[]) =>
      exported('takes/walk.bvh', '--to', 'npz', '--out', 'out', ...targets.flatMap((path) => ['--retarget', path]));
    const two = await onto('takes');
    expect([two.code, two.err]).toEqual([2, expect.stringContaining('--retarget takes one character, found 4')]);
    expect(existsSync(join(folder, 'out'))).toBe(false);
    expect((await onto('takes/two.bvh')).err).toContain('none with the joints of this take');
  });

  it('the rate of a file that states none is told, and the one that --rate gives is used: the same frames', async () => {
    writeFileSync(join(folder, 'one.asf'), ASF);
    writeFileSync(join(folder, 'one.amc'), AMC);
    const usual = await exported('one.amc', '--to', 'npz', '--out', 'usual');
    expect(usual.err).toContain('1 take: The file states no frame rate. (used 120 frames per second)\n');
    expect(manifest('usual/manifest.ndjson')[0]).toMatchObject({ fps: 120, notes: [expect.stringContaining('120')] });
    const { code, err } = await exported('one.amc', '--to', 'npz', '--out', 'known', '--rate', '50');
    expect([code, err]).toEqual([0, expect.stringContaining('(used 50 frames per second, as --rate says)')]);
    const [before, after] = [npz('usual/one.npz'), npz('known/one.npz')];
    expect(after.positions.values).toEqual(before.positions.values);
    expect(after.times.values).toEqual([0, 0.02, 0.04]);
    expect(meta('known/one.npz')).toMatchObject({ rate: 50, notes: [expect.stringContaining('50')] });
    // Stated rates stay, and the one file that is converted is the same.
    const known = await exported('takes/walk.bvh', '--to', 'npz', '--out', 'stated', '--rate', '50');
    expect(known.err).toContain('1 take: Its frame rate is known, so --rate changes nothing in it.\n');
    expect(npz('stated/takes/walk.npz').fps.values).toEqual([10]);
    expect((await command(['convert', 'one.amc', 'one.bvh', '--rate', '50'], folder)).code).toBe(0);
    expect(readFileSync(join(folder, 'one.bvh'), 'utf8')).toContain('Frame Time: 0.02\n');
  });

  it('at twice the frame rate every other frame is one of the file, the last included', async () => {
    writeFileSync(join(folder, 'thirty.bvh'), WALK.replace('Frame Time: 0.1', 'Frame Time: 0.033333'));
    await exported('thirty.bvh', '--to', 'npz', '--out', 'own', '--float64');
    await exported('thirty.bvh', '--to', 'npz', '--out', 'twice', '--float64', '--fps', '60');
    const [own, twice] = [npz('own/thirty.npz'), npz('twice/thirty.npz')];
    expect([own.positions.shape, twice.positions.shape]).toEqual([
      [11, 2, 3],
      [21, 2, 3],
    ]);
    for (const [i, value] of own.positions.values.entries()) {
      const frame = Math.floor(i / 6);
      expect(twice.positions.values[2 * 6 * frame + (i % 6)]).toBeCloseTo(Number(value), 9);
    }
    expect(twice.times.values.at(-1)).toBeCloseTo(20 / 60, 12);
  });

  it('crops, retargets and changes the frame rate before numbers are made', async () => {
    writeFileSync(join(folder, 'small.bvh'), WALK.replace('OFFSET 0 10 0', 'OFFSET 0 5 0'));
    writeFileSync(join(folder, 'map.csv'), 'target,source\nHips,Hips\nArm,Arm\n');
    const args = ['--retarget', 'small.bvh', '--map', 'map.csv', '--fps', '5', '--crop', '0.2,0.8'];
    expect((await exported('takes/walk.bvh', '--to', 'npz', '--out', 'out', ...args)).code).toBe(0);
    const { offsets, times, positions } = npz('out/takes/walk.npz');
    expect(times.values).toEqual([0.2, 0.4, 0.6, 0.8]);
    expect(positions.shape).toEqual([4, 2, 3]);
    await exported('small.bvh', '--to', 'npz', '--out', 'small');
    expect(offsets.values).toEqual(npz('small/small.npz').offsets.values);
    expect(meta('out/takes/walk.npz')).toMatchObject({
      fps: 5,
      crop: [0.2, 0.8],
      retarget: { to: 'small.bvh', map: 'map.csv' },
    });
  });

  it('--only takes the listed files, but for bad ones, and says which are not there', async () => {
    writeFileSync(
      join(folder, 'list.csv'),
      'path,verdict\ntakes/walk.bvh,good\ntakes/two.bvh,bad\nb/walk.bvh,\ngone.bvh,\n',
    );
    const { code, err } = await exported('takes', '--only', 'list.csv', '--to', 'npz', '--out', 'out');
    expect([code, err]).toEqual([0, 'marrow: list.csv lists gone.bvh, which is not among the files.\n']);
    expect(filesIn('out')).toEqual(['b/walk.npz', 'manifest.ndjson', 'walk.npz']);
    writeFileSync(join(folder, 'list.csv'), 'takes/walk.bvh\n');
    await exported('--only', 'list.csv', '--to', 'npz', '--out', 'alone');
    expect(filesIn('alone')).toEqual(['manifest.ndjson', 'takes/walk.npz']);
    const again = await exported('takes', '--only', 'list.csv', '--to', 'npz', '--out', 'out', '--resume');
    expect(again.out).toBe('out: nothing to do: 1 take already exported\n');
    expect(again.err).toMatch(
      /^marrow: 1 output from earlier runs is no longer listed but still exists: b\/walk\.npz\.\n$/,
    );
    writeFileSync(join(folder, 'list.csv'), 'path,verdict\ntakes/walk.bvh,bad\n');
    const bad = await exported('takes', '--only', 'list.csv', '--to', 'npz', '--out', 'no');
    expect([bad.code, bad.err]).toEqual([
      2,
      expect.stringContaining('--only: every take in list.csv has the verdict bad.'),
    ]);
  });

  it('paths come from the standard input too, a line each', async () => {
    const input = async () => 'takes/walk.bvh\ntakes/b/walk.bvh\n';
    const { code } = await command(['export', '--files-from', '-', '--to', 'npz', '--out', 'out'], folder, input);
    expect(code).toBe(0);
    expect(filesIn('out')).toEqual(['manifest.ndjson', 'takes/b/walk.npz', 'takes/walk.npz']);
    const none = await command(['export', '--files-from', '-', '--to', 'npz', '--out', 'no'], folder, async () => '');
    expect([none.code, none.err]).toEqual([2, expect.stringContaining('expected one path per line, found none.')]);
  });

  it('flags of the review’s checks are in the manifest, of the take as it was read', async () => {
    const rows = Array.from({ length: 61 }, (_, f) => `${f === 30 ? 400 : f} 90 0 0 0 0 0 0 0`);
    writeFileSync(join(folder, 'spike.bvh'), bvh('Hips', rows));
    await exported('spike.bvh', 'takes', '--to', 'npz', '--out', 'out', '--crop', '0,1');
    const flags = manifest()[0].flags;
    expect(flags).toEqual(expect.arrayContaining([expect.stringMatching(/^spike 3 Hips$/)]));
    await exported('spike.bvh', '--to', 'npz', '--out', 'out2', '--no-checks');
    expect(manifest('out2/manifest.ndjson')[0].flags).toBeUndefined();
  });

  it('what is called wrongly is told before anything is written', async () => {
    const wrong = async (...args: string[]) => {
      const { code, err } = await exported(...args);
      expect([code, existsSync(join(folder, 'out'))]).toEqual([2, false]);
      return err.split('\n')[0];
    };
    const all = ['takes', '--to', 'npz', '--out', 'out'];
    expect(await wrong('takes', '--out', 'out')).toBe('marrow: --to is missing: one of npz, parquet, csv, json.');
    expect(await wrong('takes', '--to', 'xlsx', '--out', 'out')).toBe(
      'marrow: --to takes one of npz, parquet, csv, json, found "xlsx".',
    );
    expect(await wrong('takes', '--to', 'npz')).toMatch('--out is missing');
    expect(await wrong('--to', 'npz', '--out', 'out')).toMatch(
      'Give files or folders with takes, --files-from or --only.',
    );
    expect(await wrong(...all, '--shard', '5/4')).toMatch('--shard takes a part and the number of parts');
    expect(await wrong(...all, '--crop', '3')).toMatch('--crop takes two times');
    expect(await wrong(...all, '--crop', '3,1')).toMatch('the earlier one first, found "3,1"');
    expect(await wrong(...all, '--jobs', '1.5')).toMatch('--jobs takes a whole number');
    expect(await wrong(...all, '--map', 'map.csv')).toMatch('--map needs --retarget');
    expect(await wrong(...all, '--retarget', 'gone.bvh')).toMatch(
      'gone.bvh error file-missing: There is no such file in',
    );
    writeFileSync(join(folder, 'map.csv'), 'Hips\n');
    expect(await wrong(...all, '--retarget', 'takes/walk.bvh', '--map', 'map.csv')).toMatch(
      'map.csv:1: Expected two names, "target,source", found "Hips".',
    );
  });
});

describeShared('marrow export, of files of other programs', () => {
  it('every animation of a glTF is a take, with the skeleton of its skin', async () => {
    const { code, err } = await exported(sharedPath('data/gltf/Fox.glb'), '--to', 'npz', '--out', 'out', '--no-checks');
    expect([code, err]).toEqual([0, '']);
    expect(filesIn('out')).toEqual(['Fox.1.npz', 'Fox.2.npz', 'Fox.3.npz', 'manifest.ndjson']);
    expect(['1', '2', '3'].map((i) => meta(`out/Fox.${i}.npz`).take)).toEqual(['Survey', 'Walk', 'Run']);
    expect(npz('out/Fox.2.npz').names.values).toContain('b_Head_05');
  });
});
