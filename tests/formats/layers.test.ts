import { describe, expect, it } from 'vitest';
import { layersReader } from '../../src/formats/layers/read.ts';
import { writeLayers } from '../../src/formats/layers/write.ts';
import { readWhole } from '../../src/formats/reader.ts';

const read = (text: string) => readWhole(layersReader('walk.layers.json'), text);
const LAYER = '"name": "arm", "file": "walk.arm.anim", "mode": "additive"';

describe('.layers.json', () => {
  it('is written with the numbers, words and unknown fields that it was read with', () => {
    const text = `{
  "base": "walk.base.anim",
  "flattened": { "file": "walk.anim", "sha256": "${'0f'.repeat(32)}", "by": "someone" },
  "layers": [
    { ${LAYER}, "weight": 0.1, "mute": true, "joints": ["upper_arm_l", "#7"], "root": true, "tag": { "a": [1, null] } },
    { "name": "face", "file": "walk.face.anim", "mode": "override", "weight": { "extrapolate": ["constant", "cycle"], "keys": [[0, 0, "flat", "smooth"], [0.3, 1, 0.25, "linear"]], "unit": "one" }, "solo": true, "morphs": true }
  ],
  "version": 3
}
`;
    const { value, diagnostics } = read(text);
    if (!value) throw new Error('It was not read.');
    expect(writeLayers(value).text).toBe(text);
    expect(diagnostics.map(({ code, message }) => [code, message.split(' ')[0]]).sort()).toEqual([
      ['field-unknown', 'flattened.by'],
      ['field-unknown', 'layers[0].tag'],
      ['field-unknown', 'layers[1].weight.unit'],
      ['field-unknown', 'version'],
    ]);
  });

  it('has a weight of 1, and nothing else, where fields are left out', () => {
    expect(read(`{ "base": "b.anim", "layers": [ { ${LAYER} } ] }`).value?.layers).toEqual([
      {
        ...{ name: 'arm', file: 'walk.arm.anim', mode: 'additive', weight: 1 },
        ...{ mute: false, solo: false, root: false, morphs: false },
      },
    ]);
  });

  it.each([
    ['[]', 'layers-wrong', 'Expected an object'],
    ['{ "layers": [] }', 'layers-wrong', 'base: expected text, found nothing'],
    ['{ "base": "b.anim" }', 'layers-wrong', 'layers: expected a list'],
    [`{ "base": "b", "layers": [ { ${LAYER}, "weight": 1e999 } ] }`, 'layers-wrong', 'layers[0].weight'],
    [
      `{ "base": "b", "layers": [ { ${LAYER}, "mute": 1 } ] }`,
      'layers-wrong',
      'layers[0].mute: expected true or false',
    ],
    [`{ "base": "b", "layers": [ { ${LAYER} }, { ${LAYER} } ] }`, 'layers-wrong', 'layers[1].name: expected a name'],
    [`{ "base": "b", "layers": [ { ${LAYER}, "joints": [3] } ] }`, 'layers-wrong', 'layers[0].joints[0]'],
    [
      `{ "base": "b", "layers": [ { ${LAYER}, "weight": { "keys": [[0, 1, "auto", "flat"]] } } ] }`,
      'layers-wrong',
      'layers[0].weight.keys[0][2]',
    ],
    ['{ "base": "b", "flattened": { "file": "a", "sha256": "12" }, "layers": [] }', 'layers-wrong', 'flattened.sha256'],
    ['{ "base": ', 'json-wrong', 'JSON'],
  ])('%s is refused', (text, code, says) => {
    const { value, diagnostics } = read(text);
    expect(value).toBeUndefined();
    expect(diagnostics).toEqual([expect.objectContaining({ code, severity: 'error' })]);
    expect(diagnostics[0].message).toContain(says);
  });

  it('takes weights and keys out of order, and says so', () => {
    const { value, diagnostics } = read(
      `{ "base": "b", "layers": [ { ${LAYER}, "weight": -1 },
        { "name": "b", "file": "b.anim", "mode": "additive", "weight": { "keys": [[1, 2, 0, 0], [0, 1, 0, 0]] } } ] }`,
    );
    expect(diagnostics.map(({ code, assumed }) => [code, assumed])).toEqual([
      ['layer-weight', 'used 0'],
      ['keys-unsorted', 'sorted'],
    ]);
    const weight = value?.layers[1].weight;
    expect(typeof weight === 'object' && [...weight.times]).toEqual([0, 1]);
  });
});
