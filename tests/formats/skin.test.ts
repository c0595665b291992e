import { describe, expect, it, vi } from 'vitest';
import { readSkin } from '../../src/formats/skin/read.ts';
import { writeSkin } from '../../src/formats/skin/write.ts';
import { told } from './read-in-pieces.ts';

const skin = (text: string) => readSkin(text, 'hero.skin');

const POSITIONS = 'positions 3 {\n0 0 0\n1 0 0\n0 1 0\n}\n';
const NORMALS = 'normals 3 {\n0 0 1\n0 0 1\n0 0 1\n}\n';
const WEIGHTS = 'skinweights 3 {\n1 0 1\n1 1 1\n2 0 0.5 1 0.5\n}\n';
const TRIANGLES = 'triangles 1 {\n0 1 2\n}\n';
const BINDINGS = 'bindings 2 {\nmatrix { 1 0 0 0 1 0 0 0 1 0 0 0 }\nmatrix { 1 0 0 0 1 0 0 0 1 4 5 6 }\n}\n';
const BLOCKS = [POSITIONS, NORMALS, WEIGHTS, TRIANGLES, BINDINGS];

describe('reading .skin', () => {
  it('reading .skin reads every block', () => {
    const texcoords = 'texcoords 3 { 0 0 1 0 0 1 }\n';
    const { value, diagnostics } = skin(`${BLOCKS.join('')}${texcoords}material face { texture head.bmp }`);
    expect(diagnostics).toEqual([]);
    expect(value).toEqual({
      name: 'hero',
      positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0),
      normals: Float64Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1),
      texcoords: Float64Array.of(0, 0, 1, 0, 0, 1),
      attachments: {
        start: Uint32Array.of(0, 1, 2, 4),
        joints: Uint32Array.of(0, 1, 0, 1),
        weights: Float64Array.of(1, 1, 0.5, 0.5),
      },
      triangles: Uint32Array.of(0, 1, 2),
      surfaces: [{ material: { name: 'face', texture: 'head.bmp' }, triangleStart: 0, triangleCount: 1 }],
      bindings: Float64Array.of(
        ...[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
        ...[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1],
      ),
    });
  });

  it('takes the blocks in any order', () => {
    const expected = skin(BLOCKS.join('')).value;
    expect(skin([...BLOCKS].reverse().join('')).value).toEqual(expected);
    expect(skin([TRIANGLES, BINDINGS, NORMALS, WEIGHTS, POSITIONS].join('')).value).toEqual(expected);
  });

  it('reading .skin has no attachments without skinweights, and no normals without normals', () => {
    const { value, diagnostics } = skin(POSITIONS + TRIANGLES);
    expect(value).toEqual({
      name: 'hero',
      positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0),
      triangles: Uint32Array.of(0, 1, 2),
      surfaces: [{ triangleStart: 0, triangleCount: 1 }],
      bindings: new Float64Array(0),
    });
    expect(told({ diagnostics })).toEqual(['info normals-computed 0:0']);
  });

  it.each([
    ['texture my  head.bmp', 'my  head.bmp'],
    ['texture "my head.bmp" }', 'my head.bmp'],
    ['texture über kopf', 'über kopf'],
    ['texture head.bmp }', 'head.bmp'],
    ['texture\nhead.bmp', 'head.bmp'],
  ])('takes a FILE as one token, in quotes, or as the rest of the line: %j', (line, texture) => {
    const { value } = skin(`${POSITIONS}material {\n${line}\n}`);
    expect(value?.surfaces[0].material).toEqual({ name: '', texture });
  });

  it('reading .skin gives each block of triangles the material named last before it', () => {
    const { value, diagnostics } = skin(
      [
        POSITIONS + NORMALS,
        'triangles 1 { 0 1 2 }',
        'material cloth { texture cloth.png }',
        'triangles 2 { 0 2 1 1 2 0 } triangles 1 { 2 2 2 }',
        'material { color 1 0.5 0 } triangles 0 { }',
        'material glass { color 0 0 1 texture "my glass.png" } triangles 1 { 1 1 1 }',
      ].join('\n'),
    );
    expect(told({ diagnostics })).toEqual(['info triangles-wound 0:0']);
    expect(value?.triangles).toEqual(Uint32Array.of(0, 1, 2, 0, 2, 1, 1, 2, 0, 2, 2, 2, 1, 1, 1));
    expect(value?.surfaces).toEqual([
      { triangleStart: 0, triangleCount: 1 },
      { material: { name: 'cloth', texture: 'cloth.png' }, triangleStart: 1, triangleCount: 3 },
      { material: { name: '', color: [1, 0.5, 0] }, triangleStart: 4, triangleCount: 0 },
      {
        material: { name: 'glass', texture: 'my glass.png', color: [0, 0, 1] },
        triangleStart: 4,
        triangleCount: 1,
      },
    ]);
  });

  it('thousands of blocks of triangles are put together without copying all for each', () => {
    let made = 0;
    class Counted extends Uint32Array {
      constructor(length: number) {
        super(length);
        made++;
      }
    }
    vi.stubGlobal('Uint32Array', Counted);
    try {
      const { value } = skin(`${POSITIONS}${'material m { } triangles 1 { 0 1 2 } '.repeat(4000)}`);
      expect(value?.triangles).toHaveLength(12_000);
      expect(made).toBeGreaterThan(0);
      expect(made).toBeLessThan(100);
    } finally {
      vi.unstubAllGlobals();
    }
  });

  it('reading .skin gives a lone material to the triangles before it, as course files may have it', () => {
    const { value, diagnostics } = skin(`${POSITIONS}${NORMALS}${TRIANGLES}material face { texture head.bmp }`);
    expect(diagnostics).toEqual([]);
    expect(value?.surfaces).toEqual([
      { material: { name: 'face', texture: 'head.bmp' }, triangleStart: 0, triangleCount: 1 },
    ]);
  });

  it.each([
    [['material a { }', 'material b { }', TRIANGLES], ['b'], ['warning repeated 12:1']],
    [[TRIANGLES, 'material a { }', 'material b { }'], ['b'], ['warning repeated 15:1']],
    [['material a { }', TRIANGLES, 'material b { }'], ['a'], ['warning material-unused 15:1']],
    [[TRIANGLES, 'material a { }', TRIANGLES, 'material b { }'], [undefined, 'a'], ['warning material-unused 18:1']],
    [[TRIANGLES, TRIANGLES], [undefined], ['warning repeated 14:1']],
    [[TRIANGLES, TRIANGLES, 'material a { }'], ['a'], ['warning repeated 14:1']],
    [['material a { color 255 0 0 }', TRIANGLES], ['a'], ['warning color-out-of-range 11:14']],
    [['material a { color 0 -1 2 }', TRIANGLES], ['a'], ['warning color-out-of-range 11:14']],
    [['material a { colour 1 0 0 }', TRIANGLES], ['a'], ['warning keyword-unknown 11:14']],
  ])('reading .skin says which of the blocks %j are used', (blocks, names, expected) => {
    const result = skin(POSITIONS + NORMALS + blocks.map((block) => block.trim()).join('\n'));
    expect(result.value?.surfaces.map(({ material }) => material?.name)).toEqual(names);
    expect(told(result)).toEqual(expected);
  });

  it('names the first triangle index out of range of each block, and of all if the positions follow', () => {
    const blocks = 'triangles 1 { 0 9 2 }\nmaterial b { }\ntriangles 2 {\n1 0 0\n0 8 7\n}\n';
    expect(told(skin(POSITIONS + NORMALS + blocks))).toEqual([
      'error index-out-of-range 11:17',
      'error index-out-of-range 15:3',
    ]);
    const late = skin(blocks + POSITIONS + NORMALS);
    expect(told(late)).toEqual(['error index-out-of-range 1:17']);
    expect(late.diagnostics[0].message).toContain('2 more');
  });

  it('uses what is there where a count says otherwise, and tells it at the count', () => {
    for (const count of ['4', '0', '-1', '1e9', '2147483648', '1e300']) {
      const { value, diagnostics } = skin(POSITIONS.replace('3', count) + NORMALS + TRIANGLES.replace('1', count));
      expect(value?.positions).toHaveLength(9);
      expect(value?.triangles).toHaveLength(3);
      expect(told({ diagnostics })).toEqual(['warning count-mismatch 1:11', 'warning count-mismatch 11:11']);
    }
  });

  it('ignores normals and texture coordinates of another count', () => {
    for (const blocks of [
      [POSITIONS, NORMALS.replace('0 0 1\n', '')],
      [NORMALS.replace('0 0 1\n', ''), POSITIONS],
    ]) {
      const { value, diagnostics } = skin(`${blocks.join('').replace('normals 3', 'normals 2')}texcoords 1 { 0 0 }`);
      expect(value?.normals).toBeUndefined();
      expect(value?.texcoords).toBeUndefined();
      const line = blocks[0] === POSITIONS ? 6 : 1;
      expect(told({ diagnostics })).toEqual([
        `warning normals-count ${line}:1`,
        'warning texcoords-count 10:1',
        'info normals-computed 0:0',
      ]);
    }
  });

  it('leaves vertices past the skinweights without attachments, and rows past the vertices out', () => {
    const fewer = skin(POSITIONS + NORMALS + WEIGHTS.replace('1 1 1\n', '').replace('3', '2') + BINDINGS);
    expect(fewer.value?.attachments?.start).toEqual(Uint32Array.of(0, 1, 3, 3));
    expect(told(fewer)).toEqual(['warning skinweights-count 11:1']);
    const more = skin(POSITIONS + NORMALS + WEIGHTS.replace('}', '1 0 1 }').replace('3', '4') + BINDINGS);
    expect(more.value?.attachments?.start).toEqual(Uint32Array.of(0, 1, 2, 4));
    expect(more.value?.attachments?.joints).toHaveLength(4);
    expect(told(more)).toEqual(['warning skinweights-count 11:1']);
  });

  it('warns once a file of weights off 1, and of vertices without attachments', () => {
    const weights = 'skinweights 6 {\n0\n1 0 0.98\n1 0 1.02\n1 0 0.995\n0\n2 0 0.25 1 0.25\n}\n';
    const six = 'positions 6 { 0 0 0 1 1 1 2 2 2 3 3 3 4 4 4 5 5 5 }\n';
    const { value, diagnostics } = skin(six + weights + BINDINGS);
    expect(value).toBeDefined();
    expect(told({ diagnostics })).toEqual([
      'warning attachments-missing 3:1',
      'warning weights-sum 4:5',
      'info normals-computed 0:0',
    ]);
    expect(diagnostics[0].message).toContain('Vertex 0 ');
    expect(diagnostics[0].message).toContain('1 other');
    expect(diagnostics[1].message).toContain('vertex 1;');
    expect(diagnostics[1].message).toContain('2 other');
  });

  it('names the first triangle index out of range, wherever the positions are', () => {
    const wrong = 'triangles 3 {\n0 1 2\n2 1 3\n 0 9 0\n}\n';
    for (const [text, line] of [
      [POSITIONS + NORMALS + wrong, 13],
      [wrong + POSITIONS + NORMALS, 3],
    ] as const) {
      const { value, diagnostics } = skin(text);
      expect(value).toBeUndefined();
      expect(diagnostics).toMatchObject([{ severity: 'error', code: 'index-out-of-range', line, column: 5 }]);
      expect(diagnostics[0].excerpt).toEqual({ text: '2 1 3', caret: 4 });
      expect(diagnostics[0].message).toContain('1 more');
    }
  });

  it('names the first joint index out of range, wherever the bindings are', () => {
    const wrong = WEIGHTS.replace('1 1 1', '1 2 1').replace('2 0 0.5 1 0.5', '2 0 0.5 7 0.5');
    for (const [text, line] of [
      [POSITIONS + NORMALS + wrong + BINDINGS, 13],
      [BINDINGS + POSITIONS + NORMALS + wrong, 17],
    ] as const) {
      const { value, diagnostics } = skin(text);
      expect(value).toBeUndefined();
      expect(diagnostics).toMatchObject([{ severity: 'error', code: 'index-out-of-range', line, column: 3 }]);
    }
  });

  it('finds an index out of range among very many ascending ones before the positions', () => {
    const rows = Array.from({ length: 2000 }, (_, i) => `${3 * i} ${3 * i + 1} ${3 * i + 2}`).join('\n');
    const positions = `positions 5000 {\n${'0 0 0\n'.repeat(5000)}}`;
    const { diagnostics } = skin(`triangles 2000 {\n${rows}\n}\n${positions}`);
    expect(diagnostics.find((d) => d.severity === 'error')).toMatchObject({ code: 'index-out-of-range', line: 1668 });
  });

  it.each([
    ['', ['error vertex-missing 1:1']],
    ['positions 0 {\n}\n', ['error vertex-missing 1:1']],
    [TRIANGLES, ['error vertex-missing 1:1', 'error index-out-of-range 2:1']],
    ['positions 1 {\n0 0\n}', ['error vertex-missing 1:1', 'error row-incomplete 3:1']],
    ['positions {\n0 0 0\n}', ['error number-expected 1:11']],
    ['positions 1.5 {\n0 0 0\n}', ['error count-fractional 1:11']],
    ['positions nan {\n0 0 0\n}', ['error not-a-number 1:11']],
    ['positions 1e999 {\n0 0 0\n}', ['error number-too-large 1:11']],
    ['positions 1\n0 0 0\n}', ['error brace-missing 2:1']],
    ['positions 1 {\n0 0 0\n', ['error brace-missing 3:1']],
    [`positions 1 {\n0 0 0\n${TRIANGLES.replace('1 2', '0 0')}`, ['error brace-missing 3:1']],
    ['positions 1 {\n0 0 x\n}', ['error not-a-number 2:5']],
    ['positions 1 {\n0 0 1e999\n}', ['error number-too-large 2:5']],
    ['positions 1 {\n0 0 nan\n}', ['error not-a-number 2:5']],
    ['positions 1 {\n{0 0 0\n}', ['error brace-unexpected 2:1']],
    [`${POSITIONS}triangles 1 { 0 1.5 2 }`, ['error index-fractional 6:17']],
    [`${POSITIONS}triangles 1 { 0 -1 2 }`, ['error index-out-of-range 6:17']],
    [`${POSITIONS}triangles 1 { 0 1 5e9 }`, ['error index-out-of-range 6:19']],
    [`${POSITIONS}triangles 1 { 0 1 }`, ['error row-incomplete 6:19']],
    [`${POSITIONS}${BINDINGS}skinweights 3 { 1 0 1 1 0 1 1 0 }`, ['error row-incomplete 10:33']],
    [`${POSITIONS}${BINDINGS}skinweights 3 { 1 0 1 1 0.5 1 1 0 1}`, ['error index-fractional 10:25']],
    [`${POSITIONS}${BINDINGS}skinweights 3 { 1 0 1 1 -1 1 1 0 1}`, ['error index-out-of-range 10:25']],
    [`${POSITIONS}${BINDINGS}skinweights 3 { 1 0 1 1.5 0 0 }`, ['error index-fractional 10:23']],
    [`${POSITIONS}${BINDINGS}skinweights 3 { 1 0 1 1e9 0 1 1 0 1}`, ['error row-incomplete 10:36']],
    [`${POSITIONS}skinweights 3 { 1 0 1 1 0 1 1 0 1}`, ['error index-out-of-range 6:19']],
    [`${POSITIONS}bindings 1 {\nmatrix { 1 0 0 0 1 0 0 0 1 0 0 }\n}`, ['error matrix-size 7:32']],
    [`${POSITIONS}bindings 1 {\nmatrix { 1 0 0 2 0 0 0 0 1 0 0 0 }\n}`, ['error binding-singular 7:1']],
    [`${POSITIONS}bindings 1 {\nmatrix { 0 0 0 0 0 0 0 0 0 0 0 0 }\n}`, ['error binding-singular 7:1']],
    [`${POSITIONS}bindings 1 {\nmatrix 1 0 0 0 1 0 0 0 1 0 0 0 }\n}`, ['error brace-missing 7:10']],
    [`${POSITIONS}material x { texture }`, ['error file-expected 6:22']],
    [`${POSITIONS}material x { color 1 0 }`, ['error number-expected 6:24']],
    [`${POSITIONS}material x { color 1 0 nan }`, ['error not-a-number 6:24']],
    [`${POSITIONS}material x { color red }`, ['error not-a-number 6:20']],
    [`${POSITIONS}triangles 1 { 0 1 2 }\nmaterial x { }\ntriangles 1 { 0 1 }`, ['error row-incomplete 8:19']],
    [`${POSITIONS}material x {`, ['error brace-missing 6:13']],
  ])('%j is an error where it is wrong', (text, expected) => {
    const result = skin(text);
    expect(result.value).toBeUndefined();
    const errors = told(result).filter((d) => d.startsWith('error'));
    expect(errors.slice(0, expected.length)).toEqual(expected);
  });

  it('says how many triangles are wound against their normals, but for a fold or two of a fine mesh', () => {
    const normals = 'normals 3 {\n0 0 1\n0 0 1\n0 0 1\n}\n';
    const wound = (right: number, wrong: number) => {
      const triangles = '0 1 2\n'.repeat(right) + '0 2 1\n'.repeat(wrong);
      const { diagnostics } = skin(`${POSITIONS}${normals}triangles ${right + wrong} {\n${triangles}}\n`);
      return diagnostics.map(({ severity, message }) => `${severity} ${message}`);
    };
    expect(wound(3, 0)).toEqual([]);
    expect(wound(3, 1)).toEqual(['info Of 4 triangles, 1 is wound against their normals.']);
    expect(wound(0, 5)).toEqual(['info Of 5 triangles, 5 are wound against their normals.']);
    expect(wound(2998, 2)).toEqual([]);
    expect(wound(2997, 3)).toHaveLength(1);
  });

  it('refuses positions that replace more of them, if triangles name those', () => {
    const replaced = (named: string, by: string) => {
      const { value, diagnostics } = readSkin(
        `positions 3 {\n0 0 0 1 0 0 0 1 0\n}\ntriangles 1 { ${named} }\npositions 1 { ${by} }`,
        'x.skin',
      );
      return { value, errors: diagnostics.filter(({ severity }) => severity === 'error') };
    };
    expect(replaced('0 1 2', '0 1 2').value).toBeUndefined();
    expect(replaced('0 1 2', '0 1 2').errors).toMatchObject([
      {
        code: 'index-out-of-range',
        line: 5,
        message: 'Triangles use 3 vertices, but these positions, which replace earlier ones, are only 1.',
      },
    ]);
    expect(replaced('0 0 0', '0 1 2').value?.positions).toEqual(Float64Array.of(0, 1, 2));
  });

  it('warns of blocks that come twice, of unknown ones and of a } too many', () => {
    const { value, diagnostics } = skin(`${BLOCKS.join('')}colors 1 {\n1 0 0\n}\n}\n${NORMALS.replaceAll('1', '-1')}`);
    expect(value?.normals?.[2]).toBe(-1);
    expect(told({ diagnostics })).toEqual([
      'warning keyword-unknown 23:1',
      'warning brace-unexpected 26:1',
      'warning repeated 27:1',
      'info triangles-wound 0:0',
    ]);
  });
});

describe('writing .skin', () => {
  it('writes the blocks as the course does', () => {
    const { value } = skin(`material face { texture "my head.bmp" } ${BLOCKS.join('')}`);
    expect(value && writeSkin(value).text).toBe(
      [
        'positions 3 {\n\t0 0 0\n\t1 0 0\n\t0 1 0\n}',
        'normals 3 {\n\t0 0 1\n\t0 0 1\n\t0 0 1\n}',
        'skinweights 3 {\n\t1 0 1\n\t1 1 1\n\t2 0 0.5 1 0.5\n}',
        'material face {\n\ttexture "my head.bmp"\n}',
        'triangles 1 {\n\t0 1 2\n}',
        'bindings 2 {\n\tmatrix {\n\t\t1 0 0\n\t\t0 1 0\n\t\t0 0 1\n\t\t0 0 0\n\t}',
        '\tmatrix {\n\t\t1 0 0\n\t\t0 1 0\n\t\t0 0 1\n\t\t4 5 6\n\t}\n}\n',
      ].join('\n'),
    );
  });

  it('writing .skin puts each material before its triangles', () => {
    const text = [
      'material cloth {\n\ttexture cloth.png\n}',
      'triangles 1 {\n\t0 1 2\n}',
      'material red {\n\tcolor 1 0 0.25\n}',
      'triangles 1 {\n\t2 1 0\n}',
    ].join('\n');
    const { value } = skin(`${POSITIONS}${NORMALS}${text}`);
    expect(value && writeSkin(value).text).toContain(`}\n${text}\nbindings`);
  });

  it('writing .skin ends a material before triangles without one', () => {
    const { value } = skin(POSITIONS + NORMALS + TRIANGLES + TRIANGLES);
    if (!value) throw new Error('not read');
    const surfaces = [
      { material: { name: 'a' }, triangleStart: 0, triangleCount: 1 },
      { triangleStart: 1, triangleCount: 1 },
    ];
    const again = skin(writeSkin({ ...value, surfaces }).text).value;
    expect(again?.surfaces.map(({ material }) => material?.name)).toEqual(['a', '']);
  });
});
