import { describe, expect, it } from 'vitest';
import { readSkel } from '../../src/formats/skel/read.ts';
import { writeSkel } from '../../src/formats/skel/write.ts';
import { DEFAULT_BOX, type Joint, UNLIMITED } from '../../src/model/skeleton.ts';
import { told } from './read-in-pieces.ts';

const skel = (text: string) => readSkel(text, 'hero.skel');
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

  it('makes a skeleton of each root, and says so', () => {
    const { value, diagnostics } = skel('balljoint a { }\nballjoint b { }\nballjoint c { }');
    expect(diagnostics).toMatchObject([{ severity: 'info', code: 'several-roots', line: 2 }]);
    expect(value?.map((s) => [s.name, s.joints.length])).toEqual([
      ['hero', 1],
      ['hero_2', 1],
      ['hero_3', 1],
    ]);
  });

  it('keeps crossed limits as they are written, with a warning', () => {
    const { value, diagnostics } = skel('balljoint a {\n rotxlimit 1 -1\n pose 5 0 0 }');
    expect(diagnostics).toMatchObject([{ severity: 'warning', code: 'limits-crossed', line: 2 }]);
    expect(value?.[0].joints[0].limits[0]).toEqual({ min: 1, max: -1 });
  });

  it('keeps a pose out of its limits, with an info where it is written', () => {
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
    ['1 0 1 0 0 0', ['error axis-angle-form 1:1']],
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
  ])('%j is an error where it is wrong', (text, expected) => {
    const result = skel(text);
    expect(result.value).toBeUndefined();
    expect(told(result)).toEqual(expected);
  });

  it('says what is wrong with a number', () => {
    const message = (n: string) => skel(`balljoint a { offset ${n} 0 0 }`).diagnostics[0].message;
    expect(message('nan')).toContain('no value');
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

  it('reads 100,000 nested joints, and tells where one of them is not closed', () => {
    const n = 100000;
    const { value } = skel('balljoint x{'.repeat(n) + '}'.repeat(n));
    expect(value?.[0].joints).toHaveLength(n);
    expect(value?.[0].joints[n - 1].parent).toBe(n - 2);
    expect(skel('balljoint x{'.repeat(n) + '}'.repeat(n - 1)).diagnostics).toMatchObject([{ code: 'brace-missing' }]);
    const again = readSkel(writeSkel(value ?? []).text, 'hero.skel');
    expect(again.value?.[0].joints).toHaveLength(n);
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

  it('changes names that the format can not hold, and says so', () => {
    const { value } = skel('balljoint a { }');
    const joints = value?.[0].joints.map((j) => ({ ...j, name: 'left {arm}\n' })) ?? [];
    const { text, diagnostics } = writeSkel([{ name: 'x', joints }], 'out.skel');
    expect(text).toMatch(/^balljoint left__arm__ \{/);
    expect(diagnostics).toMatchObject([{ severity: 'info', code: 'name-changed', file: 'out.skel' }]);
  });
});
