import { describe, expect, it } from 'vitest';
import { readDump } from '../../src/formats/dump/read.ts';
import type { DumpBlock } from '../../src/model/dump.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';

/** Two matrices, row by row, as their programs print them. */
const MATRICES: Readonly<Record<string, string>> = {
  'printf, a matrix a line': '1 0 0 4 0 1 0 5 0 0 1 6 0 0 0 1\n1 0 0 7 0 1 0 8 0 0 1 9 0 0 0 1\n',
  'printf, a row a line': '1 0 0 4\n0 1 0 5\n0 0 1 6\n0 0 0 1\n\n1 0 0 7\n0 1 0 8\n0 0 1 9\n0 0 0 1\n',
  Eigen: ' 1  0  0  4\n 0  1  0  5\n 0  0  1  6\n 0  0  0  1\n--\n 1  0  0  7\n 0  1  0  8\n 0  0  1  9\n 0  0  0  1\n',
  'glm::to_string':
    'mat4x4((1.000000, 0.0, 0.0, 4.0), (0.0, 1.0, 0.0, 5.0), (0.0, 0.0, 1.0, 6.0), (0.0, 0.0, 0.0, 1.0))\n' +
    'mat4x4((1.000000, 0.0, 0.0, 7.0), (0.0, 1.0, 0.0, 8.0), (0.0, 0.0, 1.0, 9.0), (0.0, 0.0, 0.0, 1.0))\n',
  numpy:
    '[[1. 0. 0. 4.]\n [0. 1. 0. 5.]\n [0. 0. 1. 6.]\n [0. 0. 0. 1.]]\n[[1.e+00 0. 0. 7.]\n [0. 1. 0. 8.]\n [0. 0. 1. 9.]\n [0. 0. 0. 1.]]\n',
  'numpy with repr':
    'array([[[1., 0., 0., 4.],\n  [0., 1., 0., 5.],\n  [0., 0., 1., 6.],\n  [0., 0., 0., 1.]],\n [[1., 0., 0., 7.], [0., 1., 0., 8.], [0., 0., 1., 9.], [0., 0., 0., 1.]]], dtype=float32)\n',
  'JavaScript, as Node prints typed arrays':
    'Float32Array(16) [\n  1, 0, 0, 4,\n  0, 1, 0, 5,\n  0, 0, 1, 6,\n  0, 0, 0, 1\n]\nFloat32Array(16) [\n  1, 0, 0, 7,\n  0, 1, 0, 8,\n  0, 0, 1, 9,\n  0, 0, 0, 1\n]\n',
  'JavaScript, as browsers print arrays':
    '(16) [1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6, 0, 0, 0, 1]\n(16) [1, 0, 0, 7, 0, 1, 0, 8, 0, 0, 1, 9, 0, 0, 0, 1]\n',
  'floats with an f, and semicolons': '1.0f; 0.f; 0f; 4.0f; 0;1;0;5;0;0;1;6;0;0;0;1\n1;0;0;7;0;1;0;8;0;0;1;9;0;0;0;1',
  'System.Numerics':
    '{ {M11:1 M12:0 M13:0 M14:4} {M21:0 M22:1 M23:0 M24:5} {M31:0 M32:0 M33:1 M34:6} {M41:0 M42:0 M43:0 M44:1} }\n' +
    '{ {M11:1 M12:0 M13:0 M14:7} {M21:0 M22:1 M23:0 M24:8} {M31:0 M32:0 M33:1 M34:9} {M41:0 M42:0 M43:0 M44:1} }\n',
  'numpy 2, scalars in lists':
    '[np.float64(1.0), np.float64(0.0), 0, np.float32(4.0), 0, 1, 0, 5, 0, 0, 1, 6, 0, 0, 0, 1]\n' +
    '[np.float64(1.0), np.float64(0.0), 0, np.int64(7), 0, 1, 0, 8, 0, 0, 1, 9, 0, 0, 0, 1]\n',
  'JSON lists': '[[1,0,0,4,0,1,0,5,0,0,1,6,0,0,0,1],[1,0,0,7,0,1,0,8,0,0,1,9,0,0,0,1]]',
  'JSON, a list a line': '[1,0,0,4,0,1,0,5,0,0,1,6,0,0,0,1]\r\n[1,0,0,7,0,1,0,8,0,0,1,9,0,0,0,1]\r\n',
  'a label a line': 'root:\n1 0 0 4\n0 1 0 5\n0 0 1 6\n0 0 0 1\nhead:\n1 0 0 7\n0 1 0 8\n0 0 1 9\n0 0 0 1\n',
  'all in one line': '1 0 0 4 0 1 0 5 0 0 1 6 0 0 0 1 1 0 0 7 0 1 0 8 0 0 1 9 0 0 0 1',
};
const EXPECTED = [1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6, 0, 0, 0, 1, 1, 0, 0, 7, 0, 1, 0, 8, 0, 0, 1, 9, 0, 0, 0, 1];

describe('a dump of matrices', () => {
  it.each(Object.entries(MATRICES))('reads all numbers and nothing else of %s', (_, text) => {
    const { value, diagnostics } = readDump(text, 'x.txt');
    expect(diagnostics).toEqual([]);
    expect(value?.blocks.flatMap(({ values }) => Array.from(values))).toEqual(EXPECTED);
  });
});

describe('a label in a dump', () => {
  const row = ' 1 0 0 4 0 1 0 5 0 0 1 6';
  it.each([
    ['hip:', { name: 'hip' }],
    ['mixamorig:Hips:', { name: 'mixamorig:Hips' }],
    ['left arm =', { name: 'left arm' }],
    ['Spine.001', { name: 'Spine.001' }],
    ['7:', { index: 7 }],
    ['7 hip_03_r', { index: 7, name: 'hip_03_r' }],
    ['#7:', { index: 7 }],
    ['[7]', { index: 7 }],
    ['joint 7 (hip_03_r):', { index: 7, name: 'hip_03_r' }],
    ['Joint 7 "left arm":', { index: 7, name: 'left arm' }],
    ['joint 7', { index: 7 }],
    ['vertex[7] =', { index: 7 }],
    ['joint hip:', { name: 'hip' }],
  ])('%s is read with the numbers behind it and on the lines below', (label, expected) => {
    for (const text of [`${label}${row}\n`, `${label}\n${row}\n`]) {
      if (text.startsWith('[7]\n') || text.startsWith('7 hip_03_r\n')) continue;
      const { value } = readDump(text, 'x.txt');
      expect(value?.blocks.flatMap(({ labels }) => labels ?? [])).toEqual([expect.objectContaining(expected)]);
      expect(Array.from(value?.blocks[0]?.values ?? [])).toEqual([1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6]);
    }
  });

  it('is read from the columns of a table with a header, whatever digits are in names', () => {
    const [block] = blocksOf('joint,x,y,z\n"Bone 01",1,2,3\nBone 02,4,5,6\n');
    expect(block.labels).toEqual([{ name: 'Bone 01' }, { name: 'Bone 02' }]);
    expect(block.columns).toEqual(['x', 'y', 'z']);
    expect(Array.from(block.values)).toEqual([1, 2, 3, 4, 5, 6]);
  });

  it('is not made of the names of components', () => {
    const [block] = blocksOf('x: 1, y: 2, z: 3\nhip: x=4 y=5 z=6\n');
    expect(block.labels).toEqual([null, { name: 'hip' }]);
    expect(Array.from(block.values)).toEqual([1, 2, 3, 4, 5, 6]);
  });
});

describe('a heading in a dump', () => {
  it.each(['local matrices:', 'Local matrices', '# local', '== local transforms ==', 'local 2 matrices'])(
    'begins a block: %s',
    (heading) => {
      const blocks = blocksOf(`world matrices\n1 2 3\n${heading}\n4 5 6\n`);
      expect(blocks.map(({ holds }) => holds)).toEqual(['world', 'local']);
    },
  );

  it.each([
    'time 1.5',
    '# time 1.5',
    'Time: 1.5 s',
    '// t = 1.5',
    'world matrices at time 1.5',
    'time=1.50',
    'time,1.5',
  ])('states the time: %s', (heading) => {
    expect(blocksOf(`${heading}\n1 2 3\n`)[0].time).toBe(1.5);
  });

  it('states the time of every block until the next one', () => {
    const blocks = blocksOf('world\ntime 0\n1 2 3\ntime 0.5\n4 5 6\n');
    expect(blocks.map(({ holds, time }) => [holds, time])).toEqual([
      ['world', 0],
      ['world', 0.5],
    ]);
  });

  it('tells channels apart', () => {
    const blocks = blocksOf('channel 2\n0 0.5\n1 0.6\nchannel 5 (hip.rx):\n0 0.7\n');
    expect(blocks.map(({ holds, channel, values }) => [holds, channel, Array.from(values)])).toEqual([
      ['channels', 2, [0, 0.5, 1, 0.6]],
      ['channels', 5, [0, 0.7]],
    ]);
  });

  it('with a count, as in a .skin, is no row', () => {
    const blocks = blocksOf('positions 2 {\n1 2 3\n4 5 6\n}\nnormals 2 {\n0 0 1\n0 1 0\n}\n');
    expect(blocks.map(({ holds, values }) => [holds, values.length])).toEqual([
      ['positions', 6],
      ['normals', 6],
    ]);
  });
});

describe('the time in the name of a dump', () => {
  it.each([
    ['walk@1.5.txt', 1.5],
    ['walk@-0.25.json', -0.25],
    ['walk@2', 2],
    ['walk@1e-3.obj', 0.001],
  ])('%s', (name, time) => {
    expect(readDump('1 2 3', name).value?.time).toBe(time);
  });

  it('is not made of other signs', () => {
    expect(readDump('1 2 3', 'me@home.txt').value?.time).toBeUndefined();
  });
});

describe('a dump as JSON', () => {
  it('has matrices by name, as lists of numbers or of rows, and points as objects', () => {
    const blocks = blocksOf(
      JSON.stringify({
        time: 2,
        world: { root: Array(16).fill(1), head: Array(16).fill(2) },
        local: [Array(4).fill(Array(4).fill(3))],
        vertices: [{ x: 1, y: 2, z: 3 }],
      }),
      'x.json',
    );
    expect(blocks.map(({ holds, time, nesting, values }) => [holds, time, nesting, values.length])).toEqual([
      ['world', 2, 'flat', 32],
      ['local', 2, 'rows', 16],
      ['vertices', 2, undefined, 3],
    ]);
    expect(blocks[0].labels).toEqual([{ name: 'root' }, { name: 'head' }]);
  });

  it('has frames of a take, each with its time', () => {
    const frame = (time: number) => ({ time, positions: [[time, 0, 0]] });
    const blocks = blocksOf(JSON.stringify([frame(0), frame(0.5)]), 'x.json');
    expect(blocks.map(({ time, values }) => [time, values[0]])).toEqual([
      [0, 0],
      [0.5, 0.5],
    ]);
  });

  it('may be a dict of Python, with single quotes', () => {
    const [block] = blocksOf("{'root': [0.5, 0.0, nan], 'arm': [1e-05, 2.0, None]}", 'x.txt');
    expect(block.labels).toEqual([{ name: 'root' }, { name: 'arm' }]);
    expect(block.values).toEqual(Float64Array.of(0.5, 0, Number.NaN, 1e-5, 2, Number.NaN));
  });

  it('has NaN as other programs print it', () => {
    expect(blocksOf('{"positions": [[NaN, 1, null]]}', 'x.json')[0].values).toEqual(
      Float64Array.of(Number.NaN, 1, Number.NaN),
    );
  });

  it('has channels with their times, or rows of a time and values', () => {
    const [marrow] = blocksOf('{"channels": [[1, 2], [3, 4]], "times": [0, 0.5]}', 'x.json');
    expect([marrow.holds, marrow.times, marrow.values]).toEqual([
      'channels',
      Float64Array.of(0, 0.5),
      Float64Array.of(1, 2, 3, 4),
    ]);
    const [rows] = blocksOf('{"channels": [{"time": 0, "values": [1, 3]}, {"time": 0.5, "values": [2, 4]}]}', 'x.json');
    expect(rows.values).toEqual(Float64Array.of(0, 1, 3, 0.5, 2, 4));
  });
});

describe('a dump as a mesh', () => {
  it('has v and vn of an OBJ, without colours, texture coordinates and faces', () => {
    const blocks = blocksOf(
      'o x\nv 1 2 3 0.5 0.5 0.5\nvt 0 1\nvn 0 0 1\nv 4 5 6\nvn 0 1 0\nf 1//1 2//2 1//1\n',
      'x.obj',
    );
    expect(blocks.map(({ holds, values }) => [holds, Array.from(values)])).toEqual([
      ['vertices', [1, 2, 3, 4, 5, 6]],
      ['normals', [0, 0, 1, 0, 1, 0]],
    ]);
  });

  it('has x y z and nx ny nz of a PLY, in any order', () => {
    const header = ['nx', 'ny', 'nz', 'red', 'x', 'y', 'z'].map((name) => `property float ${name}\n`).join('');
    const blocks = blocksOf(`ply\nformat ascii 1.0\nelement vertex 1\n${header}end_header\n0 0 1 255 4 5 6\n`, 'x.ply');
    expect(blocks.map(({ holds, values }) => [holds, Array.from(values)])).toEqual([
      ['vertices', [4, 5, 6]],
      ['normals', [0, 0, 1]],
    ]);
  });
});

describe('what is no dump', () => {
  it.each([
    [
      'prose',
      'This is the readme of a project.\nIt was made in 2024 by 3 students.\nSee the file for more about it all.\n',
    ],
    ['settings', '{"name": "marrow", "version": "1.0.0"}'],
    ['nothing', ''],
  ])('%s has no blocks', (_, text) => {
    expect(readDump(text, 'README.txt').value?.blocks).toEqual([]);
  });

  it('numbers that the program left out are an error with its line', () => {
    const { value, diagnostics } = readDump('[[1. 0. 0.]\n ...\n [0. 0. 1.]]\n', 'x.txt');
    expect(value).toBeUndefined();
    expect(diagnostics).toMatchObject([{ severity: 'error', code: 'dump-shortened', line: 2 }]);
  });

  it('a binary PLY and a short row of an OBJ are errors', () => {
    expect(readDump('ply\nformat binary_little_endian 1.0\n', 'x.ply').diagnostics).toMatchObject([
      { code: 'ply-binary', line: 2 },
    ]);
    expect(readDump('v 1 2 3\nv 1 2\n', 'x.obj').diagnostics).toMatchObject([{ code: 'row-incomplete', line: 2 }]);
  });
});

describeShared('the dumps of the reference', () => {
  it('read all numbers of joints, whatever layout they are in', () => {
    const count = (name: string) =>
      readDump(sharedBytes(`conformance/compare/${name}`), name).value?.blocks.map(({ values }) => values.length);
    expect(count('d000.txt')).toEqual([23 * 16]);
    expect(count('d010.txt')).toEqual([23 * 16]);
    expect(count('d014.txt')).toEqual([23 * 12]);
    expect(count('d005@0.199998.csv')).toEqual([22 * 16]);
    expect(count('d020.txt')).toEqual([22 * 16]);
    expect(count('d039.json')).toEqual([23 * 16]);
  });
});

function blocksOf(text: string, name = 'x.txt'): readonly DumpBlock[] {
  const { value, diagnostics } = readDump(text, name);
  expect(diagnostics).toEqual([]);
  return value?.blocks ?? [];
}

describe('a dump of long lines and many', () => {
  const numbers = Array.from({ length: 3000 }, (_, i) => i / 8);

  it.each([
    ['a label', `hip: ${numbers.join(', ')}`],
    ['a name in each pair of brackets', `hip: ${numbers.map((value) => `(${value})`).join(' vec3 ')}`],
  ])('all numbers behind %s are read', (_, text) => {
    const [block] = readDump(text, 'x.txt').value?.blocks ?? [];
    expect([...block.values]).toEqual(numbers);
    expect(block.labels).toEqual([{ name: 'hip' }]);
  });

  it('a line with hundreds of names among its numbers is prose', () => {
    const text = `hip: ${numbers.map((value) => `${value} and somebody`).join(' ')}`;
    expect(readDump(text, 'x.txt').value?.blocks).toEqual([]);
  });

  it('rows that are labelled late have no label before, and equal labels are held once', () => {
    const [block] = readDump(`1 2 3\n${'hip: 1 2 3\nhead: 4 5 6\n'.repeat(100)}`, 'x.txt').value?.blocks ?? [];
    const [none, hip, head, again] = block.labels ?? [];
    expect([none, hip, head]).toEqual([null, { name: 'hip' }, { name: 'head' }]);
    expect(again).toBe(hip);
    expect([...block.starts.slice(0, 3), block.starts.at(-1)]).toEqual([0, 3, 6, 603]);
    expect([block.lines[0], block.lines.at(-1), block.lines.length]).toEqual([1, 201, 201]);
  });

  it('rows of JSON are of the line of their key, in each of several texts too', () => {
    const lines = (text: string) =>
      [...(readDump(text, 'x.json').value?.blocks ?? [])].flatMap((block) => [...block.lines]);
    expect(lines('{\n"time": 1,\n"world":\n[[1, 0, 0]]}')).toEqual([3]);
    expect(lines('{"world": [[1, 0, 0], [2, 0, 0]]}\n{"world": [[3, 0, 0]]}')).toEqual([1, 1, 2]);
    expect(lines("{'world': [[1, 0, 0]]}\n{'world': [[3, 0, 0]]}")).toEqual([1, 2]);
    const keys = Array.from({ length: 40 }, (_, i) => `"world_${i}": [[${i}, 0, 0]]`);
    expect(lines(`{\n${keys.join(',\n')}}`).slice(0, 16)).toEqual(Array.from({ length: 16 }, (_, i) => i + 2));
  });

  it('of lines of JSON of which one is none, nothing is read as JSON', () => {
    const plain = readDump('[1, 2, 3]\n[4, 5, 6]\nhip: 7 8 9', 'x.txt').value?.blocks ?? [];
    expect(plain.flatMap(({ values }) => [...values])).toEqual([1, 2, 3, 4, 5, 6, 7, 8, 9]);
    expect(plain.flatMap(({ holds, nesting }) => [holds, nesting])).toEqual(
      plain.flatMap(() => [undefined, undefined]),
    );
  });
});
