import { describe, expect, it } from 'vitest';
import { compileTake } from '../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../src/evaluate/curves.ts';
import { readAnim } from '../../src/formats/anim/read.ts';
import { writeAnim } from '../../src/formats/anim/write.ts';
import { keysOf, restChannel } from '../../src/model/takes/take.ts';
import { FIXED_TANGENT, FLAT, LINEAR, SMOOTH } from '../../src/model/takes/tangent-kinds.ts';
import { told } from './read-in-pieces.ts';

const anim = (text: string) => readAnim(text, 'walk.anim');
const animation = (channels: string, range = 'range 0 1') => anim(`animation {\n${range}\n${channels}\n}\n`);
const channel = (keys: string, extrapolate = 'extrapolate cycle bounce') =>
  animation(`channel {\n${extrapolate}\n${keys}\n}`);

describe('reading .anim', () => {
  it('reading .anim reads keys into columns', () => {
    const { value, diagnostics } = channel('keys 3 { 0 1 flat LINEAR\n 0.5 -1 Smooth 2.5\n 1 3 -1e-3 flat }');
    expect(diagnostics).toEqual([]);
    expect(value).toEqual({
      name: 'walk',
      range: [0, 1],
      channels: [
        {
          kind: 'keys',
          extrapolateIn: 'cycle',
          extrapolateOut: 'bounce',
          times: Float64Array.of(0, 0.5, 1),
          values: Float64Array.of(1, -1, 3),
          tangentsIn: { kinds: Uint8Array.of(FLAT, SMOOTH, FIXED_TANGENT), slopes: Float64Array.of(0, 0, -1e-3) },
          tangentsOut: { kinds: Uint8Array.of(LINEAR, FIXED_TANGENT, FLAT), slopes: Float64Array.of(0, 2.5, 0) },
        },
      ],
    });
  });

  it('reads many channels, of no keys and of many', () => {
    const many = Array.from({ length: 5000 }, (_, i) => `${i} ${-i} smooth ${i / 2}`).join('\n');
    const text = `channel { keys 0 { } extrapolate linear CYCLE_OFFSET } channel {keys 5000{\n${many}}extrapolate constant constant}`;
    const { value, diagnostics } = animation(text, 'range -1 2 numchannels 2');
    expect(diagnostics).toEqual([]);
    expect(value?.channels.map((c) => keysOf(c).times.length)).toEqual([0, 5000]);
    expect(value?.channels[0]).toMatchObject({ extrapolateIn: 'linear', extrapolateOut: 'cycle_offset' });
    expect(keysOf(value?.channels[1]).values[4999]).toBe(-4999);
    expect(keysOf(value?.channels[1]).tangentsOut.slopes[4999]).toBe(2499.5);
  });

  it('sorts keys that are out of order, and says so', () => {
    const { value, diagnostics } = channel('keys 4 {\n2 20 flat flat\n0 1 linear 5\n1 3 flat flat\n0 2 smooth flat\n}');
    expect(keysOf(value?.channels[0]).times).toEqual(Float64Array.of(0, 0, 1, 2));
    expect(keysOf(value?.channels[0]).values).toEqual(Float64Array.of(1, 2, 3, 20));
    expect(keysOf(value?.channels[0]).tangentsIn.kinds).toEqual(Uint8Array.of(LINEAR, SMOOTH, FLAT, FLAT));
    expect(keysOf(value?.channels[0]).tangentsOut.slopes).toEqual(Float64Array.of(5, 0, 0, 0));
    expect(told({ diagnostics })).toEqual(['warning keys-unsorted 7:1', 'warning keys-at-one-time 7:1']);
  });

  it('warns of two keys at one time and keeps both in their order', () => {
    const { value, diagnostics } = channel('keys 3 {\n0 1 flat flat\n1 3 flat flat\n1 2 flat flat\n}');
    expect(keysOf(value?.channels[0]).values).toEqual(Float64Array.of(1, 3, 2));
    expect(told({ diagnostics })).toEqual(['warning keys-at-one-time 8:1']);
  });

  it('swaps a reversed range, and keeps a negative one', () => {
    const keys = 'channel { extrapolate constant constant keys 1 { 0 0 flat flat } }';
    expect(animation(keys, 'range -2 -1')).toMatchObject({ value: { range: [-2, -1] }, diagnostics: [] });
    const { value, diagnostics } = animation(keys, 'range 3 1');
    expect(value?.range).toEqual([1, 3]);
    expect(told({ diagnostics })).toEqual(['warning range-reversed 2:1']);
  });

  it('uses what is there where a count says otherwise, and tells it at the count', () => {
    for (const count of ['7', '0', '-3', '1e12']) {
      const { value, diagnostics } = animation(
        `numchannels ${count}\nchannel {\nextrapolate constant constant\nkeys ${count} {\n0 0 flat flat\n}\n}`,
      );
      expect(keysOf(value?.channels[0]).times).toHaveLength(1);
      expect(told({ diagnostics })).toEqual(['warning count-mismatch 3:13', 'warning count-mismatch 6:6']);
    }
  });

  it('reading .anim is constant where no extrapolation is given, and says so once', () => {
    const { value, diagnostics } = animation(
      'channel { keys 1 { 0 0 flat flat } }\nchannel { keys 1 { 0 0 flat flat } }',
    );
    expect(value?.channels[1]).toMatchObject({ extrapolateIn: 'constant', extrapolateOut: 'constant' });
    expect(diagnostics).toMatchObject([{ severity: 'warning', code: 'extrapolate-missing', line: 3 }]);
  });

  it('plays all keys where no range is given, and says so', () => {
    const { value, diagnostics } = animation(
      'channel { extrapolate cycle cycle keys 2 { -1 0 flat flat 4 0 flat flat } }',
      '',
    );
    expect(value?.range).toEqual([-1, 4]);
    expect(told({ diagnostics })).toEqual(['warning range-missing 0:0']);
  });

  it('tells of a file that ends in the middle of a word once for each thing that is wrong', () => {
    const { diagnostics } = readAnim('animation { range 0 1 channel { extrapolate co', 'a.anim');
    expect(diagnostics.map((d) => d.code)).toEqual(['extrapolation-unknown', 'brace-missing']);
  });

  it('reading .anim is constant, in a file too, if a channel has a value and no keys', () => {
    const made = { name: 'a', range: [2, 3] as const, channels: [restChannel(0.25)] };
    const { text } = writeAnim(made);
    expect(text).toMatch(/keys 1 \{\s+2 0.25 flat flat\s+\}/);
    const read = readAnim(text, 'a.anim').value;
    expect(read && evaluateChannel(compileTake(read), 0, -7)).toBe(0.25);
  });

  it('skips what it does not know', () => {
    const { value, diagnostics } = anim(
      'version 2\nanimation {\nrange 0 1\nfps 30\nchannel {\nname hip\nextrapolate cycle cycle\nkeys 1 { 0 0 flat flat }\n}\n}\n}',
    );
    expect(value?.channels).toHaveLength(1);
    expect(told({ diagnostics })).toEqual([
      'warning keyword-unknown 1:1',
      'warning keyword-unknown 4:1',
      'warning keyword-unknown 6:1',
      'warning brace-unexpected 11:1',
    ]);
  });

  it.each([
    ['', ['error animation-missing 1:1']],
    ['animation {\nrange 0 1\nnumchannels 0\n}', ['error channel-missing 1:1']],
    ['animation {\nrange 0 1\nchannel {\nextrapolate co', ['error extrapolation-unknown 4:13']],
    ['animation {\nrange 0\nchannel { }\n}', ['error number-expected 3:1']],
    ['animation {\nrange 0 1', ['error brace-missing 2:10']],
    ['animation {\nnumchannels 1.5\nrange 0 1 channel { }\n}', ['error count-fractional 2:13']],
  ])('%j is an error where it is wrong', (text, expected) => {
    const result = anim(text);
    expect(result.value).toBeUndefined();
    const errors = told(result).filter((d) => d.startsWith('error'));
    expect(errors.slice(0, expected.length)).toEqual(expected);
  });

  it.each([
    ['keys 1 {\n0 0 flat curvy\n}', 'error tangent-unknown 6:10'],
    ['keys 1 {\n0 0 flat 1,5\n}', 'error not-a-number 6:10'],
    ['keys 1 {\n0 0 flat nan\n}', 'error not-a-number 6:10'],
    ['keys 1 {\n0 0 flat 1e999\n}', 'error number-too-large 6:10'],
    ['keys 1 {\n0 flat 0 flat\n}', 'error number-expected 6:3'],
    ['keys 1 {\n0 curvy flat flat\n}', 'error not-a-number 6:3'],
    ['keys 1 {\ninf 0 flat flat\n}', 'error not-a-number 6:1'],
    ['keys 1 {\n0 0 flat\n}', 'error row-incomplete 7:1'],
    ['keys 1 {\n0 0 flat flat\nextrapolate cycle cycle\n}', 'error brace-missing 7:1'],
    ['keys {\n0 0 flat flat\n}', 'error number-expected 5:6'],
    ['keys 1.5 {\n0 0 flat flat\n}', 'error count-fractional 5:6'],
    ['keys 1 \n0 0 flat flat\n}', 'error brace-missing 6:1'],
  ])('%j in a channel is an error where it is wrong', (keys, expected) => {
    const result = channel(keys);
    expect(result.value).toBeUndefined();
    expect(told(result).filter((d) => d.startsWith('error'))[0]).toBe(expected);
  });

  it.each([
    ['extrapolate cycle forever', 'error extrapolation-unknown 4:19'],
    ['extrapolate cycle', 'error extrapolation-unknown 5:1'],
    ['extrapolate', 'error extrapolation-unknown 5:1'],
    ['extrapolate 1 2', 'error extrapolation-unknown 4:13'],
  ])('%j is an error where it is wrong', (extrapolate, expected) => {
    const result = channel('keys 1 { 0 0 flat flat }', extrapolate);
    expect(result.value).toBeUndefined();
    expect(told(result)[0]).toBe(expected);
  });
});
