import { describe, expect, it } from 'vitest';
import { limbsReader } from '../../src/formats/limbs/read.ts';
import { writeLimbs } from '../../src/formats/limbs/write.ts';
import { readWhole } from '../../src/formats/reader.ts';

const read = (text: string) => readWhole(limbsReader('walk.limbs.json'), text);
const limb = (more = '') =>
  `{ "limbs": [ { "name": "leg", "joints": ["a", "b", "c"], "bend": { "dof": "rx", "sign": 1 }${more} } ] }`;
const goal = (more = '') => `{ "base": "b.anim", "goals": [ { "limb": "leg", "channels": {}${more} } ] }`;

describe('.limbs.json', () => {
  it('is written with the numbers, words and unknown fields that it was read with', () => {
    const text = `{
  "limbs": [
    { "name": "leg", "joints": ["thigh", "#7", "foot"], "tip": [0, -0.1, 0.02], "orient": true, "bend": { "dof": "rx", "sign": -1, "by": 1 }, "tag": null },
    { "name": "tail", "joints": ["tail1", "tail2", "tail3", "tail4"] }
  ],
  "base": "walk.base.anim",
  "flattened": { "file": "walk.anim", "sha256": "${'0f'.repeat(32)}" },
  "goals": [
    { "limb": "leg", "space": "parent", "channels": { "blend": 0.5, "tx": { "extrapolate": ["constant", "cycle"], "keys": [[0, 0, "flat", "smooth"], [0.3, 1, 0.25, "linear"]], "unit": "m" }, "bend": -1, "qx": [2] } },
    { "limb": "tail", "space": [[0, "world"], [1.2, "hand_r"]], "channels": {}, "colour": "red" }
  ],
  "version": 3
}
`;
    const { value, diagnostics } = read(text);
    if (!value) throw new Error('It was not read.');
    expect(writeLimbs(value).text).toBe(text);
    expect(diagnostics.map(({ code, message }) => [code, message.split(' ')[0]]).sort()).toEqual([
      ['field-unknown', 'goals[0].channels.qx'],
      ['field-unknown', 'goals[0].channels.tx.unit'],
      ['field-unknown', 'goals[1].colour'],
      ['field-unknown', 'limbs[0].bend.by'],
      ['field-unknown', 'limbs[0].tag'],
      ['field-unknown', 'version'],
    ]);
  });

  it('has a tip at the pivot, no orientation and the world’s space where these are left out', () => {
    expect(read(limb()).value?.limbs).toEqual([
      { name: 'leg', joints: ['a', 'b', 'c'], tip: [0, 0, 0], orient: false, bend: { dof: 'rx', sign: 1 } },
    ]);
    expect(read(goal()).value?.goals).toEqual([{ limb: 'leg', space: 'world', channels: {} }]);
  });

  it.each([
    ['[]', 'limbs-wrong', 'Expected an object'],
    ['{}', 'limbs-wrong', '"limbs"'],
    ['{ "goals": [] }', 'limbs-wrong', 'base: expected text, found nothing'],
    [limb().replace('["a", "b", "c"]', '"a"'), 'limbs-wrong', 'limbs[0].joints: expected a list'],
    [limb().replace('"sign": 1', '"sign": "up"'), 'limbs-wrong', 'limbs[0].bend.sign'],
    [limb().replace(/, "bend".*\} \}/, ' }'), 'limbs-wrong', 'limbs[0].bend: expected an object, found nothing'],
    [limb(', "tip": [0, 1]'), 'limbs-wrong', 'limbs[0].tip: expected three numbers'],
    [limb(', "tip": [0, 1, 1e999]'), 'limbs-wrong', 'limbs[0].tip[2]'],
    [limb(', "orient": 1'), 'limbs-wrong', 'limbs[0].orient: expected true or false'],
    [limb().replace(/\[ (\{.*\}) \] \}$/, '[ $1, $1 ] }'), 'limbs-wrong', 'limbs[1].name: expected a name'],
    [goal().replace(/\[ (\{.*\}) \] \}$/, '[ $1, $1 ] }'), 'limbs-wrong', 'goals[1].limb: expected a name'],
    [goal(', "space": []'), 'limbs-wrong', 'goals[0].space'],
    [goal(', "space": [[0]]'), 'limbs-wrong', 'goals[0].space[0]'],
    [
      goal().replace('{}', '{ "tx": { "keys": [[0, 1, "bent", 0]] } }'),
      'limbs-wrong',
      'goals[0].channels.tx.keys[0][2]',
    ],
    ['{ "limbs": ', 'json-wrong', 'JSON'],
  ])('%s is refused', (text, code, says) => {
    const { value, diagnostics } = read(text);
    expect(value).toBeUndefined();
    expect(diagnostics).toEqual([expect.objectContaining({ code, severity: 'error' })]);
    expect(diagnostics[0].message).toContain(says);
  });

  it('takes spaces out of order, and says so', () => {
    const { value, diagnostics } = read(goal(', "space": [[1, "parent"], [0, "world"]]'));
    expect(diagnostics.map(({ code, assumed }) => [code, assumed])).toEqual([['keys-unsorted', 'sorted']]);
    expect(value?.goals?.[0].space).toEqual([
      [0, 'world'],
      [1, 'parent'],
    ]);
  });
});
