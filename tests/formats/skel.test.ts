import { describe, expect, it } from 'vitest';
import { readSkel } from '../../src/formats/skel/read.ts';
import { writeSkel } from '../../src/formats/skel/write.ts';
import { DEFAULT_BOX, type Joint, UNLIMITED } from '../../src/model/skeleton/skeleton.ts';
import { told } from './read-in-pieces.ts';

const skel = (text: string) => readSkel(text, 'hero.skel');
const zeros = (count: number) => new Array<number>(count).fill(0);
const joints = (text: string) => {
  const { value, diagnostics } = skel(text);
  expect(diagnostics).toEqual([]);
  return value?.[0].joints ?? [];
};
/** The only joint of a sound file. */
function joint(tokens: string): Joint {
  const { value, diagnostics } = skel(`balljoint root {\n${tokens}\n}`);
  expect(diagnostics).toEqual([]);
  return value?.[0].joints[0] as Joint;
}

describe('reading .skel', () => {
  it('takes the defaults for what is not there', () => {
    expect(joint('')).toEqual({
      name: 'root',
      parent: -1,
      offset: [0, 0, 0],
      box: DEFAULT_BOX,
      motion: { kind: 'ball', order: 'xyz' },
      limits: [UNLIMITED, UNLIMITED, UNLIMITED],
      pose: [0, 0, 0],
    });
  });

  it('takes tokens in any order, case and layout, and children between them', () => {
    const text = 'BallJoint a{pose 1 2 3 BALLJOINT b{Offset\r1\n2\t3}rotYlimit -1 4 boxMAX 1 1 1 order ZYX}';
    const { value, diagnostics } = skel(text);
    expect(diagnostics).toEqual([]);
    expect(value?.[0].joints).toMatchObject([
      { name: 'a', parent: -1, pose: [1, 2, 3], motion: { order: 'zyx' }, box: { max: [1, 1, 1] } },
      { name: 'b', parent: 0, offset: [1, 2, 3] },
    ]);
    expect(value?.[0].joints[0].limits[1]).toEqual({ min: -1, max: 4 });
  });

  it('reads limit NAME as it reads the classic tokens', () => {
    expect(joint('limit rx -1 1 limit RZ 0 2').limits).toEqual(joint('rotxlimit -1 1 rotzlimit 0 2').limits);
  });

  it('reads what each type has of its own, and takes the defaults for what is not there', () => {
    const read = (type: string, tokens: string) => {
      const { value, diagnostics } = skel(`${type} a {\n${tokens}\n}`);
      expect(diagnostics).toEqual([]);
      return value?.[0].joints[0];
    };
    const x = [1, 0, 0];
    expect(read('hingejoint', '')).toMatchObject({ motion: { kind: 'hinge', axis: x }, pose: [0] });
    expect(read('HingeJoint', 'AXIS 0 2 0 limit r -1 1')).toMatchObject({
      motion: { kind: 'hinge', axis: [0, 2, 0] },
      limits: [{ min: -1, max: 1 }],
    });
    expect(read('universaljoint', 'order ZX')?.motion).toEqual({ kind: 'universal', order: 'zx' });
    expect(read('quaternionjoint', '')?.pose).toEqual([0, 0, 0, 1]);
    expect(read('prismaticjoint', 'length 2')).toMatchObject({ motion: { kind: 'prismatic', axis: x }, length: 2 });
    expect(read('translationaljoint', 'pose 1 2 3')?.pose).toEqual([1, 2, 3]);
    expect(read('freejoint', 'order yxz')).toMatchObject({ motion: { kind: 'free', order: 'yxz' }, pose: zeros(6) });
    expect(read('screwjoint', 'pitch 0.5')?.motion).toEqual({ kind: 'screw', axis: x, pitch: 0.5 });
    expect(read('scalejoint', '')).toMatchObject({ motion: { kind: 'scale', mode: 'uniform', axis: x }, pose: [1] });
    expect(read('scalejoint', 'pose 1 2 3 mode xyz')).toMatchObject({ motion: { mode: 'xyz' }, pose: [1, 2, 3] });
    expect(read('shearjoint', '')?.pose).toEqual([0, 0, 0]);
    expect(read('fixedjoint', '')).toMatchObject({ motion: { kind: 'fixed' }, limits: [], pose: [] });
    expect(read('compoundjoint', 'dofs tx\nsy RZ offset 1 2 3')).toMatchObject({
      motion: { kind: 'compound', dofs: ['tx', 'sy', 'rz'] },
      offset: [1, 2, 3],
    });
  });

  it('finds the DOF that another follows by a name or an index, wherever its joint is', () => {
    const text = [
      ...['hingejoint a.b {', ' couple r b.rx 2 -1', ' balljoint b { couple RY #2.r 0.5 0', ' couple rz b.ry 1 0 }'],
      ...[' hingejoint b.c { couple r a.b.r 1 0 }', ' hingejoint { }', '}'],
    ].join('\n');
    const [couples, others, last] = joints(text).map((j) => j.couples);
    expect(couples).toEqual([{ dof: 'r', joint: 1, follows: 'rx', gain: 2, offset: -1 }]);
    expect(others).toEqual([
      { dof: 'ry', joint: 2, follows: 'r', gain: 0.5, offset: 0 },
      { dof: 'rz', joint: 1, follows: 'ry', gain: 1, offset: 0 },
    ]);
    expect(last).toEqual([{ dof: 'r', joint: 0, follows: 'r', gain: 1, offset: 0 }]);
  });

  it('takes the later one of two couples for a DOF, with a warning', () => {
    const { value, diagnostics } = skel('balljoint a {\n couple rx a.ry 1 0\n couple rx a.rz 2 0\n}');
    expect(diagnostics).toMatchObject([{ severity: 'warning', code: 'repeated', line: 3, column: 9 }]);
    expect(value?.[0].joints[0].couples).toMatchObject([{ follows: 'rz', gain: 2 }]);
  });

  it('warns of limits that its DOFs do not take, and of those that it has not', () => {
    expect(told(skel('quaternionjoint a {\n limit qx -1 1\n}'))).toEqual(['warning limits-not-taken 2:8']);
    expect(told(skel('hingejoint a {\n rotxlimit -1 1\n}'))).toEqual(['warning dof-unknown 2:2']);
    expect(told(skel('hingejoint a {\n order xyz\n}'))).toEqual(['warning keyword-unknown 2:2']);
  });

  it('numbers joints depth first, and lets names repeat or be missing', () => {
    const { value } = skel('balljoint a { balljoint { balljoint a { } } balljoint a{ } }');
    expect(value?.[0].joints.map(({ name, parent }) => [name, parent])).toEqual([
      ['a', -1],
      ['', 0],
      ['a', 1],
      ['a', 0],
    ]);
  });

  it('takes anything for a name, keywords and numbers too', () => {
    const { value, diagnostics } = skel('balljoint offset { balljoint 12 { } balljoint balljoint { } }');
    expect(diagnostics).toEqual([]);
    expect(value?.[0].joints.map((j) => j.name)).toEqual(['offset', '12', 'balljoint']);
  });

  it('reading .skel makes a skeleton of each root, and says so', () => {
    const { value, diagnostics } = skel('balljoint a { }\nballjoint b { }\nballjoint c { }');
    expect(diagnostics).toMatchObject([{ severity: 'info', code: 'several-roots', line: 2 }]);
    expect(value?.map((s) => [s.name, s.joints.length])).toEqual([
      ['hero', 1],
      ['hero_2', 1],
      ['hero_3', 1],
    ]);
  });

  it('reading .skel keeps crossed limits as they are written, with a warning', () => {
    const { value, diagnostics } = skel('balljoint a {\n rotxlimit 1 -1\n pose 5 0 0 }');
    expect(diagnostics).toMatchObject([{ severity: 'warning', code: 'limits-crossed', line: 2 }]);
    expect(value?.[0].joints[0].limits[0]).toEqual({ min: 1, max: -1 });
  });

  it('reading .skel keeps a pose out of its limits, with an info where it is written', () => {
    const { value, diagnostics } = skel('balljoint a {\n pose 5 0 0\n rotxlimit -1 1\n}');
    expect(diagnostics).toMatchObject([{ severity: 'info', code: 'pose-out-of-limits', line: 2 }]);
    expect(value?.[0].joints[0].pose).toEqual([5, 0, 0]);
  });

  it('names the joint where the default pose is out of its limits', () => {
    expect(told(skel('balljoint a {\n rotxlimit 1 2\n}'))).toEqual(['info pose-out-of-limits 1:1']);
  });

  it('skips an unknown keyword with the rest of its line, or its block', () => {
    for (const unknown of ['mass 2', 'mass {\n 1 2 { offset 9 9 9 } \n}', 'mass\n{\n offset 9 9 9\n}', 'mass { } ']) {
      const { value, diagnostics } = skel(`balljoint a {\n ${unknown}\n offset 1 2 3 }`);
      expect(diagnostics).toMatchObject([{ severity: 'warning', code: 'keyword-unknown', line: 2, column: 2 }]);
      expect(value?.[0].joints[0].offset).toEqual([1, 2, 3]);
    }
  });

  it('stops skipping where the joint ends', () => {
    const { value, diagnostics } = skel('balljoint a { mass 2 } balljoint b { }');
    expect(diagnostics.map((d) => d.code)).toEqual(['keyword-unknown', 'several-roots']);
    expect(value).toHaveLength(2);
  });

  it('warns of a } too many and of numbers too many', () => {
    expect(told(skel('balljoint a {\n}\n}\n'))).toEqual(['warning brace-unexpected 3:1']);
    expect(told(skel('balljoint a {\n offset 1 2 3 4\n}'))).toEqual(['warning number-unexpected 2:15']);
    expect(told(skel('balljoint a {\n pose 1 2 3 4\n}'))).toEqual(['warning pose-too-long 2:2']);
  });

  it.each([
    ['', ['error joint-missing 1:1']],
    ['  \n\t\n', ['error joint-missing 1:1']],
    ['\uFEFF', ['error joint-missing 1:1']],
    ['balljoint', ['error brace-missing 1:10', 'error brace-missing 1:10']],
    ['balljoint a', ['error brace-missing 1:12', 'error brace-missing 1:12']],
    ['balljoint a {', ['error brace-missing 1:14']],
    ['balljoint a {\n balljoint b {\n }\n', ['error brace-missing 4:1']],
    ['balljoint a\n offset 1 2 3\n}', ['error brace-missing 2:2']],
    ['balljoint a {\n offset 1 2\n}', ['error number-expected 3:1']],
    ['balljoint a {\n offset 1 2\n pose 0 0 0\n}', ['error number-expected 3:2']],
    ['balljoint a {\n offset\n}', ['error number-expected 3:1']],
    ['balljoint a {\n offset 1 two 3\n}', ['error not-a-number 2:11']],
    ['balljoint a {\n offset 1 2 inf\n}', ['error not-a-number 2:13']],
    ['balljoint a {\n offset 0x10 2 3\n}', ['error not-a-number 2:9']],
    ['balljoint a {\n offset 12x5 2 3\n}', ['error not-a-number 2:9']],
    ['balljoint a {\n offset 1e999 2 3\n}', ['error number-too-large 2:9']],
    ['balljoint a {\n pose 0 0\n}', ['error number-expected 2:2']],
    ['balljoint a {\n pose 0 nan 0\n}', ['error not-a-number 2:9']],
    ['balljoint a {\n rotxlimit 1\n}', ['error number-expected 3:1']],
    ['balljoint a {\n order xxy\n}', ['error order-unknown 2:8']],
    ['balljoint a {\n order\n}', ['error order-unknown 3:1']],
    ['balljoint a {\n limit 1 2\n}', ['error name-expected 2:8']],
    ['balljoint a {\n limit rx 2\n}', ['error number-expected 3:1']],
    ['universaljoint a {\n order xx\n}', ['error order-unknown 2:8']],
    ['hingejoint a {\n axis 0 -0 0\n}', ['error axis-zero 2:2']],
    ['hingejoint a {\n axis 0 zero 0\n}', ['error not-a-number 2:9']],
    ['hingejoint a {\n axis 0 0\n}', ['error number-expected 3:1']],
    ['screwjoint a {\n pitch\n}', ['error number-expected 3:1']],
    ['scalejoint a {\n mode some\n}', ['error mode-unknown 2:7']],
    ['compoundjoint a {\n dofs tx rw ty\n}', ['error dofs-unknown 2:10']],
    ['compoundjoint a {\n dofs tx ty tx\n}', ['error dofs-repeated 2:13']],
    ['compoundjoint a {\n dofs tx ty\n pose 1\n}', ['error number-expected 3:2']],
    ['hingejoint a {\n length -1\n}', ['error length-negative 2:2']],
    ['balljoint a {\n couple rw a.rx 1 0\n}', ['error dof-unknown 2:9']],
    ['balljoint a {\n couple rx a.rw 1 0\n}', ['error dof-unknown 2:12']],
    ['balljoint a {\n couple rx b.ry 1 0\n}', ['error joint-unknown 2:12']],
    ['balljoint a {\n couple rx #1.ry 1 0\n}', ['error joint-unknown 2:12']],
    ['balljoint a {\n couple rx ry 1 0\n}', ['error couple-target 2:12']],
    ['balljoint a {\n couple rx a.ry 1\n}', ['error number-expected 3:1']],
    ['balljoint a {\n couple rx\n}', ['error name-expected 3:1']],
    ['balljoint a {\n couple 1 a.rx 1 0\n}', ['error name-expected 2:9']],
    ['balljoint a { couple rx b.rx 1 0\nballjoint b { }\nballjoint b { } }', ['error joint-ambiguous 1:25']],
    ['balljoint a {\n couple rx a.rx 1 0\n}', ['error couple-cycle 2:9']],
    [
      'balljoint a {\n couple rx b.rx 1 0\n balljoint b { couple rx a.rx 1 0\n couple rz b.rx 1 0 } }',
      ['error couple-cycle 2:9', 'error couple-cycle 3:23', 'error couple-cycle 4:9'],
    ],
  ])('%j is an error where it is wrong', (text, expected) => {
    const result = skel(text);
    expect(result.value).toBeUndefined();
    expect(told(result)).toEqual(expected);
  });

  it('says what is wrong with a number', () => {
    const message = (n: string) => skel(`balljoint a { offset ${n} 0 0 }`).diagnostics[0].message;
    expect(message('nan')).toContain('not a number');
    expect(message('-inf')).toContain('finite');
    expect(message('0x1F')).toContain('hexadecimal');
    expect(message('1,5')).toContain('comma');
    expect(message('12x5')).toContain('after the number');
    expect(message('1e999')).toContain('too large');
  });

  it('reads on after an error, and finds the next one', () => {
    expect(told(skel('balljoint a {\n offset 1 2\n pose 0 zero 0\n balljoint b {\n boxmin 1,0 0 0 }\n}'))).toEqual([
      'error number-expected 3:2',
      'error not-a-number 3:9',
      'error not-a-number 5:9',
    ]);
  });
});

describe('writing .skel', () => {
  it('uses the classic tokens only for a skeleton of xyz balljoints, and leaves out defaults', () => {
    const text = [
      ...['balljoint root {', '\toffset 0 0 0', '\trotxlimit -1 1', '\tpose 0 0.5 -0', '\tballjoint {'],
      ...['\t\toffset 1e-7 1e+21 -2.5', '\t\tboxmin -1 -1 -1', '\t}', '}', ''],
    ].join('\n');
    const { value } = skel(text);
    expect(writeSkel(value ?? []).text).toBe(text);
  });

  it('writes an order that is not xyz', () => {
    const { value } = skel('balljoint a { order zxy }');
    expect(writeSkel(value ?? []).text).toBe('balljoint a {\n\toffset 0 0 0\n\torder zxy\n}\n');
  });

  it('writes what each type has of its own, and leaves out defaults', () => {
    const text = [
      ...['freejoint root {', '\toffset 0 0 0', '\tlimit tx -1 1', '\trotxlimit -1 1', '\thingejoint {'],
      ...['\t\toffset 0 0 0', '\t\taxis 0 2 0', '\t\tlimit r 0 1', '\t\tlength 3', '\t\tpose 0.5', '\t}'],
      ...['\tscalejoint s {', '\t\toffset 0 0 0', '\t\tmode xyz', '\t\tcouple sy #1.r 0.5 1', '\t}'],
      ...['\tcompoundjoint c {', '\t\toffset 0 0 0', '\t\tdofs rz tx', '\t\tcouple tx s.sx 1 0', '\t}', '}', ''],
    ].join('\n');
    expect(writeSkel(skel(text).value ?? []).text).toBe(text);
  });

  it('calls a joint by its index where no name is its own as it is written', () => {
    const names = ['a', 'a', '', '#1', 'b c', 'b_c', 'd'];
    const couples = names.map((_, i) => ({ dof: 'rx', joint: i, follows: 'ry', gain: 1, offset: 0 }));
    const [one] = joints('balljoint a { }');
    const all = names.map((name, i): Joint => ({ ...one, name, parent: i - 1, couples: [couples[i]] }));
    const { text } = writeSkel([{ name: 'x', joints: all }]);
    expect(text.match(/couple rx \S+/g)?.map((line) => line.slice(10))).toEqual([
      '#0.ry',
      '#1.ry',
      '#2.ry',
      '#3.ry',
      '#4.ry',
      '#5.ry',
      'd.ry',
    ]);
    expect(joints(text).map((j) => j.couples)).toEqual(couples.map((couple) => [couple]));
  });

  it('writing .skel makes joints of .skel of those of BVH, and says that End Sites are left out', () => {
    const [root] = joints('balljoint a { offset 1 2 3 }');
    const channels = ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'] as const;
    const motion = { kind: 'bvh', channels, positions: 'replace' } as const;
    const limits = channels.map(() => UNLIMITED);
    const bvh: Joint = { ...root, motion, limits, pose: [1, 2, 3, 0.3, 0.1, 0.2], endSites: [[0, 1, 0]] };
    const { text, diagnostics } = writeSkel([{ name: 'x', joints: [bvh] }], 'x.skel');
    expect(text).toBe('freejoint a {\n\toffset 0 0 0\n\torder yxz\n\tpose 1 2 3 0.1 0.2 0.3\n}\n');
    expect(diagnostics).toMatchObject([{ severity: 'info', code: 'end-sites-left-out' }]);
  });

  it('changes names that the format can not hold, and says so', () => {
    const { value } = skel('balljoint a { }');
    const joints = value?.[0].joints.map((j) => ({ ...j, name: 'left {arm}\n' })) ?? [];
    const { text, diagnostics } = writeSkel([{ name: 'x', joints }], 'out.skel');
    expect(text).toMatch(/^balljoint left__arm__ \{/);
    expect(diagnostics).toMatchObject([{ severity: 'info', code: 'name-changed', file: 'out.skel' }]);
  });
});
