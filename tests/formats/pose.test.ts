import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { readPoses } from '../../src/formats/pose/read.ts';
import { writePoses } from '../../src/formats/pose/write.ts';
import type { PoseByNames } from '../../src/model/pose-by-names.ts';
import { finite } from './arbitraries.ts';

const read = (text: string) => readPoses(text, 'hero.pose');

/** What a line can hold: no braces, line ends or halves of characters, and no blanks at its ends. */
const lineName = fc
  .string({ unit: 'grapheme', minLength: 1, maxLength: 12 })
  .filter(
    (s) =>
      !/[{}\r\n]/.test(s) && s.trim() === s && s.replace(/^[ \t]+|[ \t]+$/g, '') === s && !/\p{Surrogate}/u.test(s),
  );
const dofName = fc.constantFrom('rx', 'ry', 'rz', 'tx', 'r', 'qw', 'hxy', 's');
const pose: fc.Arbitrary<PoseByNames> = fc
  .record(
    {
      name: lineName,
      root: fc.tuple(finite, finite, finite),
      joints: fc.array(
        fc.record({
          name: fc.oneof(lineName, fc.constant('')),
          dofs: fc.uniqueArray(fc.record({ name: dofName, value: finite }), { selector: (d) => d.name, maxLength: 5 }),
        }),
        { maxLength: 5 },
      ),
      weights: fc.array(fc.record({ name: lineName, value: finite }), { maxLength: 3 }),
    },
    { requiredKeys: ['name', 'joints', 'weights'] },
  )
  // fast-check's records have no prototype.
  .map(({ joints, weights, ...rest }) => ({
    ...rest,
    joints: joints.map(({ name, dofs }) => ({ name, dofs: dofs.map((d) => ({ ...d })) })),
    weights: weights.map((w) => ({ ...w })),
  }));

describe('.pose', () => {
  it('reads back what was written, to the last bit, whatever the names', () => {
    fc.assert(
      fc.property(fc.array(pose, { minLength: 1, maxLength: 3 }), (poses) => {
        const { text, diagnostics } = writePoses(poses, 'hero.pose');
        expect(diagnostics).toEqual([]);
        expect(read(text)).toEqual({ value: poses, diagnostics: [] });
      }),
    );
  });

  it('.pose is written as a person would', () => {
    const poses: readonly PoseByNames[] = [
      {
        name: 'low over the ground',
        root: [0, 1.5, 0],
        joints: [
          {
            name: 'hip',
            dofs: [
              { name: 'rx', value: 0.1 },
              { name: 'ry', value: -2 },
            ],
          },
          { name: '', dofs: [] },
        ],
        weights: [{ name: 'smile', value: 0.5 }],
      },
    ];
    expect(writePoses(poses).text).toBe(
      'pose low over the ground {\n\troot 0 1.5 0\n\tjoint hip { rx 0.1 ry -2 }\n\tjoint { }\n\tweight 0.5 smile\n}\n',
    );
  });

  it('says where a name had to be changed', () => {
    const { diagnostics } = writePoses([{ name: 'a {b}', joints: [], weights: [] }], 'hero.pose');
    expect(diagnostics.map((d) => [d.severity, d.code])).toEqual([['info', 'name-changed']]);
  });

  it('takes blanks, line ends and braces wherever a person puts them', () => {
    const text = 'POSE sting\r\n{\r\njoint hip\r\n{\r\nRX\t1\r\nry 2 rz 3}\r\njoint knee{r 4}root 1 2 3 }';
    expect(read(text).value).toEqual([
      {
        name: 'sting',
        root: [1, 2, 3],
        joints: [
          {
            name: 'hip',
            dofs: [
              { name: 'rx', value: 1 },
              { name: 'ry', value: 2 },
              { name: 'rz', value: 3 },
            ],
          },
          { name: 'knee', dofs: [{ name: 'r', value: 4 }] },
        ],
        weights: [],
      },
    ]);
  });

  it('calls a pose without a name after its file', () => {
    expect(read('pose { } pose { }').value?.map(({ name }) => name)).toEqual(['hero', 'hero 2']);
  });

  it.each([
    ['', 'pose-missing', 1],
    ['pose a {\njoint hip {\nrx 1\n}\n', 'brace-missing', 5],
    ['pose a {\njoint hip {\nrx ten\n}\n}', 'not-a-number', 3],
    ['pose a {\njoint hip {\nrx NaN\n}\n}', 'not-a-number', 3],
    ['pose a {\nroot 1 2\n}', 'number-expected', 3],
  ])('.pose refuses %j, naming the line', (text, code, line) => {
    const { value, diagnostics } = read(text);
    expect(value).toBeUndefined();
    const [first] = diagnostics.filter(({ severity }) => severity === 'error');
    expect([first.code, first.line]).toEqual([code, line]);
  });

  it.each([
    ['pose a {\ntail 3\njoint hip { rx 1 }\n}', 'keyword-unknown'],
    ['pose a {\njoint hip { spin 3\nrx 1 }\n}', 'keyword-unknown'],
    ['pose a {\njoint hip { rx 2 rx 1 }\n}', 'repeated'],
    ['pose a {\njoint hip { rx 1 } } }', 'brace-unexpected'],
    ['mesh { 1 2 3 }\npose a { joint hip { rx 1 } }', 'keyword-unknown'],
  ])('warns of %j, and takes the rest', (text, code) => {
    const { value, diagnostics } = read(text);
    expect(value?.[0].joints).toEqual([{ name: 'hip', dofs: [{ name: 'rx', value: 1 }] }]);
    expect(diagnostics.map((d) => [d.severity, d.code])).toEqual([['warning', code]]);
  });
});
