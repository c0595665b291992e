import { describe, expect, it } from 'vitest';
import { attachReader } from '../../src/formats/attach/read.ts';
import { writeAttach } from '../../src/formats/attach/write.ts';
import { readWhole } from '../../src/formats/reader.ts';

const read = (text: string) => readWhole(attachReader('sword.attach.json'), text);
const row = (more: string) =>
  `{ "base": "b.anim", "attached": [ { "character": "a", "joint": "b", "span": [0, 1], "offset": { "position": [0, 0, 0], "rotation": [0, 0, 0] }${more} } ] }`;

describe('.attach.json', () => {
  it('is written with the numbers and unknown fields that it was read with', () => {
    const text = `{
  "base": "sword.base.anim",
  "flattened": { "file": "sword.anim", "sha256": "${'0f'.repeat(32)}" },
  "attached": [
    { "character": "walker", "joint": "hand_r", "span": [-0.5, 2], "offset": { "position": [0, 0.1, -0], "rotation": [0, 0, 1.57], "scale": 2 }, "colour": "red" },
    { "character": "walker", "joint": "#3", "span": [2, 2.5], "offset": { "position": [1, 2, 3], "rotation": [0, 0, 0] } }
  ],
  "version": 3
}
`;
    const { value, diagnostics } = read(text);
    if (!value) throw new Error('It was not read.');
    expect(writeAttach(value).text).toBe(text);
    expect(diagnostics.map(({ code, message }) => [code, message.split(' ')[0]]).sort()).toEqual([
      ['field-unknown', 'attached[0].colour'],
      ['field-unknown', 'attached[0].offset.scale'],
      ['field-unknown', 'version'],
    ]);
  });

  it.each([
    ['[]', 'Expected an object'],
    ['{ "attached": [] }', 'base: expected text, found nothing'],
    [row('').replace('[0, 1]', '[1, 1]'), 'attached[0].span: expected two times, the first before the second'],
    [row('').replace('[0, 1]', '[0]'), 'attached[0].span: expected two times'],
    [row('').replace('"b",', '7,'), 'attached[0].joint: expected text, found 7'],
    [row('').replace('"position": [0, 0, 0]', '"position": [0, 0]'), 'attached[0].offset.position: expected three'],
    [row('').replace(', "rotation": [0, 0, 0]', ''), 'attached[0].offset.rotation: expected a list, found nothing'],
  ])('%s is an error', (text, message) => {
    const { value, diagnostics } = read(text);
    expect(value).toBeUndefined();
    expect(diagnostics[0]).toMatchObject({ code: 'attach-wrong', severity: 'error' });
    expect(diagnostics[0].message).toContain(message);
  });
});
