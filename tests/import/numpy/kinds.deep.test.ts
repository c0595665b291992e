/** What the kinds of arrays are read as. */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, it } from 'vitest';
import { metresPerUnit } from '../../../src/evaluate/space/metres.ts';
import { readNpz } from '../../dataset/read-npz.ts';
import { command } from '../../helpers/command.ts';
import { eachWorld } from '../../helpers/lab.ts';
import { characterIn, type MadeArray, npyOf, npyWith, npzOf, readArrays } from '../../helpers/numpy.ts';

const folder = mkdtempSync(join(tmpdir(), 'marrow-numpy-'));
afterAll(() => rmSync(folder, { recursive: true }));

/** Numbers between -0.5 and 0.5, the same in every run. */
function wave(...shape: readonly number[]): MadeArray {
  const count = shape.reduce((product, n) => product * n, 1);
  return [shape, Float64Array.from({ length: count }, (_, i) => 0.5 * Math.sin(1 + 1.7 * i))];
}

const messagesOf = async (name: string, bytes: Uint8Array) =>
  (await readArrays(name, bytes)).diagnostics.map(({ message, assumed = '' }) => `${message} ${assumed}`).join('\n');

describe('Marrow’s own arrays', () => {
  const BVH = `HIERARCHY
ROOT Hips
{
  OFFSET 0 90 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Spine
  {
    OFFSET 0 10 1
    CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
    JOINT Head
    {
      OFFSET 0 40 0
      CHANNELS 3 Zrotation Xrotation Yrotation
      End Site
      {
        OFFSET 0 20 3
      }
      End Site
      {
        OFFSET 1 20 3
      }
    }
  }
  JOINT Leg
  {
    OFFSET 9 -5 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 -80 0
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.05
0 90 0 10 20 30 0 10 1 -40 50 160 70 -80 90 5 15 25
1 91 2 12 22 32 1 11 2 -42 52 162 72 -89 92 6 16 26
2 92 4 14 24 34 2 12 3 -44 54 164 74 -90 94 7 17 27
`;

  it.each([[['--float64']], [[]], [['--float64', '--raw']]])(
    'what is exported with %j is read and exported again as the same arrays',
    async (options) => {
      const name = `take${options.length}.bvh`;
      writeFileSync(join(folder, name), BVH);
      const exportOf = async (input: string, out: string) => {
        const { code, err } = await command(['export', input, '--to', 'npz', '--out', out, ...options], folder);
        expect([code, err]).toEqual([0, expect.not.stringContaining('error')]);
        return new Uint8Array(readFileSync(join(folder, out, input.replace(/\.\w+$/, '.npz'))));
      };
      const first = await exportOf(name, 'first');
      writeFileSync(join(folder, name.replace('.bvh', '.npz')), first);
      const [a, b] = [readNpz(first), readNpz(await exportOf(name.replace('.bvh', '.npz'), 'again'))];
      expect(Object.keys(b)).toEqual(Object.keys(a));
      const tolerance = options.includes('--float64') ? 1e-9 : 2e-6;
      for (const [array, { shape, values }] of Object.entries(a)) {
        if (array === 'meta') continue;
        expect(b[array].shape, array).toEqual(shape);
        // Velocities are differences, divided by the time of a frame.
        const most = tolerance * (array === 'velocities' ? 400 : options.includes('--raw') ? 200 : 1);
        values.forEach((v, i) => {
          const other = b[array].values[i];
          if (typeof v === 'string' || typeof other === 'string') expect(other, array).toBe(v);
          else expect(Math.abs(v - other), `${array} ${i}`).toBeLessThanOrEqual(most);
        });
      }
    },
  );

  const minimal: Readonly<Record<string, MadeArray>> = {
    names: [[3], ['a', 'b', 'c']],
    parents: [[3], Float64Array.of(1, -1, 0)],
    offsets: wave(3, 3),
    local_quat: [[1, 3, 4], Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)],
  };

  it('parents may come after their children', async () => {
    const { character } = await characterIn('x.npz', npzOf(minimal));
    expect(character.skeleton.joints.map(({ name, parent }) => [name, parent])).toEqual([
      ['b', -1],
      ['a', 0],
      ['c', 1],
    ]);
  });

  it('a loop, another number of joints, and no frames are errors', async () => {
    const loop = { ...minimal, parents: [[3], Float64Array.of(1, 0, -1)] as const };
    expect(await messagesOf('x.npz', npzOf(loop))).toContain('found a loop');
    const few = { ...minimal, offsets: wave(2, 3) };
    expect(await messagesOf('x.npz', npzOf(few))).toContain('3 names, 3 parents, 2 offsets');
    const none = { ...minimal, local_quat: [[0, 3, 4], new Float64Array(0)] as const };
    expect(await messagesOf('x.npz', npzOf(none))).toContain('Expected joints and frames');
  });
});

describe('motions of SMPL’s family', () => {
  const parts = { root_orient: wave(4, 3), pose_body: wave(4, 63), trans: wave(4, 3) };

  it.each([
    [72, 24],
    [156, 52],
    [165, 55],
  ])('poses of %d numbers have %d joints, with z up', async (width, count) => {
    const { character } = await characterIn('x.npz', npzOf({ poses: wave(4, width) }));
    expect(character.skeleton.joints).toHaveLength(count);
    expect(character.space?.space).toMatchObject({ up: 'z', unit: 'metres', known: 'stated' });
  });

  it('a rate that is no number is told as such', async () => {
    const arrays = { poses: wave(4, 72), fps: [[1], ['60']] as const };
    expect(await messagesOf('x.npz', npzOf(arrays))).toContain('fps holds texts or Python objects instead of a number');
  });

  it('another width is an error', async () => {
    expect(await messagesOf('x.npz', npzOf({ poses: wave(4, 66) }))).toContain('found the shape (4, 66)');
  });

  it('parts are the same as poses of all joints', async () => {
    const hands = wave(4, 90);
    const face = { pose_jaw: wave(4, 3), pose_eye: wave(4, 6) };
    const rows = [0, 1, 2, 3].flatMap((frame) =>
      [parts.root_orient, parts.pose_body, face.pose_jaw, face.pose_eye, hands].flatMap(([[, width], data]) => [
        ...data.slice(frame * width, (frame + 1) * width),
      ]),
    );
    const poses = [[4, 165], Float64Array.from(rows.map(Number))] as const;
    const whole = await characterIn('x.npz', npzOf({ poses, trans: parts.trans }));
    const split = await characterIn('x.npz', npzOf({ ...parts, ...face, pose_hand: hands }));
    expect(split.take).toEqual(whole.take);
    expect(split.character.skeleton).toEqual(whole.character.skeleton);
  });

  it('hands of another width are coefficients: they are left at rest, and that is said', async () => {
    const bytes = npzOf({ ...parts, left_hand_pose: wave(4, 6), right_hand_pose: wave(4, 12) });
    expect(await messagesOf('x.npz', bytes)).toContain('left_hand_pose and right_hand_pose');
    const { take, character } = await characterIn('x.npz', bytes);
    const wrist = character.skeleton.joints.findIndex(({ name }) => name === 'left_wrist');
    expect(character.skeleton.joints[wrist + 1].name).toBe('left_index1');
    const row = take.samples?.values.slice(3 * (wrist + 2), 3 * (wrist + 2) + 3) ?? [];
    expect([...row]).toEqual([0, 0, 0]);
  });

  it('a part of other frames is an error', async () => {
    expect(await messagesOf('x.npz', npzOf({ ...parts, trans: wave(5, 3) }))).toContain(
      'Expected 4 frames of 3 numbers in trans',
    );
    expect(await messagesOf('x.npz', npzOf({ ...parts, jaw_pose: wave(5, 3) }))).toContain('in jaw_pose');
  });

  it('the neutral body is an adult, mirrored, and it is said', async () => {
    const poses: MadeArray = [[1, 156], new Float64Array(156)];
    const { character, take, diagnostics } = await characterIn('x.npz', npzOf({ poses }));
    expect(diagnostics.map(({ code }) => code)).toContain('neutral-proportions');
    const at = new Map<string, readonly number[]>();
    eachWorld(character.skeleton, take, (world) => {
      character.skeleton.joints.forEach(({ name }, j) => {
        at.set(name, [...world.slice(16 * j + 12, 16 * j + 15)]);
      });
    });
    const [head, ankle] = ['head', 'left_ankle'].map((name) => at.get(name)?.[1] ?? 0);
    expect(head - ankle).toBeGreaterThan(1.4);
    expect(head - ankle).toBeLessThan(1.5);
    expect(at.get('pelvis')).toEqual([0, -0.22, 0.03]);
    for (const [name, [x, y, z]] of at) {
      const other = at.get(name.replace('left', 'right')) ?? [];
      if (!name.startsWith('left')) continue;
      expect(other[0], name).toBeCloseTo(-x, 12);
      expect([other[1], other[2]], name).toEqual([y, z]);
    }
  });

  it('joints of each frame give the offsets that they were made with', async () => {
    const rest = wave(52, 3);
    const given = { poses: wave(5, 156), trans: wave(5, 3) };
    const { character, take } = await characterIn('x.npz', npzOf({ ...given, J: rest }));
    const names = character.skeleton.joints.map(({ name }) => name);
    const order = (await characterIn('y.npz', npzOf({ poses: wave(1, 156) }))).character.skeleton.joints;
    expect(order.map(({ name }) => name)).toEqual(names);
    const smpl = (await import('../../../src/import/numpy/smpl-tree.ts')).bodyTree(52).names;
    const joints = new Float64Array(5 * 52 * 3);
    eachWorld(character.skeleton, take, (world, _dofs, frame) => {
      smpl.forEach((name, j) => {
        const from = 16 * names.indexOf(name) + 12;
        joints.set(world.slice(from, from + 3), 3 * (52 * frame + j));
      });
    });
    const again = await characterIn('x.npz', npzOf({ ...given, joints: [[5, 52, 3], joints] }));
    again.character.skeleton.joints.forEach(({ offset }, j) => {
      offset.forEach((v, k) => {
        expect(v).toBeCloseTo(character.skeleton.joints[j].offset[k], 9);
      });
    });
  });

  it('a body that stands along y has y up, if it is given by global_orient', async () => {
    const bytes = npzOf({ global_orient: [[1, 3], new Float64Array(3)], body_pose: wave(1, 69) });
    expect((await characterIn('x.npz', bytes)).character.space?.space.up).toBe('y');
    const turned: MadeArray = [[1, 3], Float64Array.of(Math.PI / 2, 0, 0)];
    const lying = npzOf({ global_orient: turned, body_pose: wave(1, 69) });
    expect((await characterIn('x.npz', lying)).character.space?.space.up).toBe('z');
  });
});

describe('positions of joints', () => {
  it('they are converted to motion capture, with the same joints', async () => {
    writeFileSync(join(folder, 'people.npy'), npyOf(wave(7, 25, 3)));
    expect((await command(['convert', 'people.npy', 'people.bvh'], folder)).code).toBe(0);
    const facts = async (name: string) => JSON.parse((await command(['info', name, '--json'], folder)).out).files[0];
    const [npy, bvh] = [await facts('people.npy'), await facts('people.bvh')];
    expect([bvh.joints, bvh.frames]).toEqual([25, 7]);
    expect([npy.joints, npy.frames, npy.frameTime]).toEqual([25, 7, 1 / 30]);
  });

  it('a tree of the file’s own is used, with its names and its rate', async () => {
    const bytes = npzOf({
      positions: wave(7, 4, 3),
      parents: [[4], Float64Array.of(-1, 0, 1, 0)],
      names: [[4], ['a', 'b', 'c', 'd']],
      fps: [[], Float64Array.of(50)],
    });
    const { character, take } = await characterIn('x.npz', bytes);
    expect(character.skeleton.joints.map(({ name, parent }) => [name, parent])).toEqual([
      ['a', -1],
      ['b', 0],
      ['c', 1],
      ['d', 0],
    ]);
    expect(take.samples?.frameSeconds).toBe(0.02);
  });

  it.each(['joints', 'joints3d', 'keypoints', 'anything'])('the array may be called %s', async (name) => {
    const arrays = { [name]: wave(7, 22, 3), other: wave(3, 3), betas: wave(16) };
    const { character } = await characterIn('x.npz', npzOf(arrays));
    expect(character.skeleton.joints).toHaveLength(22);
  });

  it('what no kind has is listed by name and shape, with what is read', async () => {
    const told = await messagesOf('x.npz', npzOf({ weights: wave(2, 5), more: wave(3, 7, 3) }));
    expect(told).toMatch(/Found weights \(2, 5\), more \(3, 7, 3\)\. Expected .*17, 22.*HumanML3D/);
    expect(await messagesOf('x.npy', npyOf(wave(3)))).toContain('the array (3,)');
  });

  it('a body that stands still for ten minutes is read, however little its file takes', async () => {
    const { take } = await characterIn('x.npz', npzOf({ poses: [[36_000, 156], new Float32Array(36_000 * 156)] }));
    expect(take.samples?.frameCount).toBe(36_000);
  });

  it('what takes so little for so many numbers that it is no motion is told so, with what to do', async () => {
    const shape = "{'descr': '|u1', 'fortran_order': False, 'shape': (200000, 156), }\n";
    const told = await messagesOf('x.npz', npzOf({ poses: npyWith(shape, new Uint8Array(200_000 * 156)) }));
    expect(told).toMatch(/more than 24 million numbers, packed into \d+ bytes.*save them without compression/);
  });

  it('no frames are an error', async () => {
    expect(await messagesOf('x.npy', npyOf([[0, 22, 3], new Float64Array(0)]))).toContain('found none');
  });
});

describe('HumanML3D', () => {
  it('is in metres, y up, 20 frames per second; normalised data is told', async () => {
    const [shape, data] = wave(6, 263);
    const { character, take, diagnostics } = await characterIn('x.npy', npyOf([shape, data]));
    expect(1 / (take.samples?.frameSeconds ?? 0)).toBeCloseTo(20, 9);
    expect(character.space && metresPerUnit(character.space.space)).toBe(1);
    expect(diagnostics.some(({ code }) => code === 'data-normalised')).toBe(true);

    const above = Float64Array.from(data, Number).map((v, i) => (i % 263 === 3 ? 1 : v));
    const standing = await characterIn('x.npy', npyOf([shape, above]));
    expect(standing.diagnostics.some(({ code }) => code === 'data-normalised')).toBe(false);
    // Bones that are six times as long in the last frame as in the first.
    const growing = above.map((v, i) => v * (1 + Math.floor(i / 263)));
    const doubtful = await characterIn('x.npy', npyOf([shape, growing]));
    expect(doubtful.diagnostics.map(({ code }) => code)).toContain('bones-doubtful');
    expect(standing.diagnostics.map(({ code }) => code)).not.toContain('bones-doubtful');
  });
});
