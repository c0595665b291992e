import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { numberOf, numbersOf, parseArguments, UsageError } from '../../src/cli/arguments.ts';

const TYPES = { time: 'value', root: 'value', json: 'flag' } as const;

describe('arguments', () => {
  it('option values follow a blank or an equals sign', () => {
    expect(parseArguments(['--time', '2'], TYPES).value('time')).toBe('2');
    expect(parseArguments(['--time=2'], TYPES).value('time')).toBe('2');
  });

  it('option values may begin with a minus, either way', () => {
    const given = parseArguments(['--time', '-1', '--root=-1,-2,-3', 'a.skel'], TYPES);
    expect(given.value('time')).toBe('-1');
    expect(given.value('root')).toBe('-1,-2,-3');
    expect(given.files).toEqual(['a.skel']);
  });

  it('option values may contain an equals sign, or be empty', () => {
    expect(parseArguments(['--time=a=b'], TYPES).value('time')).toBe('a=b');
    expect(parseArguments(['--time='], TYPES).value('time')).toBe('');
    expect(parseArguments(['--time', ''], TYPES).value('time')).toBe('');
  });

  it('arguments take files before, between and after options', () => {
    const given = parseArguments(['a.skel', '--json', 'b c.skin', '--time', '1', 'd.anim'], TYPES);
    expect(given.files).toEqual(['a.skel', 'b c.skin', 'd.anim']);
    expect(given.flag('json')).toBe(true);
  });

  it('arguments take everything after -- for files', () => {
    const given = parseArguments(['--', '--json', '-x.skel'], TYPES);
    expect(given.files).toEqual(['--json', '-x.skel']);
    expect(given.flag('json')).toBe(false);
  });

  it('a repeated option gives its last value, or all of them', () => {
    const given = parseArguments(['--time', '1', '--time=2'], TYPES);
    expect(given.value('time')).toBe('2');
    expect(given.values('time')).toEqual(['1', '2']);
    expect(given.values('root')).toEqual([]);
  });

  it.each([
    ['an option that is not there', ['--tiem', '1']],
    ['a name of every object', ['--constructor', '1']],
    ['a short option', ['-t']],
    ['an option without its value', ['--time']],
    ['a flag with a value', ['--json=yes']],
  ])('arguments refuse %s', (_, args) => {
    expect(() => parseArguments(args, TYPES)).toThrow(UsageError);
  });
});

describe('numbers in arguments', () => {
  it('numbers in arguments are read back as every double that JS prints', () => {
    fc.assert(
      fc.property(fc.array(fc.double({ noNaN: true, noDefaultInfinity: true })), (values) => {
        expect(numbersOf('x', values.join(','))).toEqual(values.map((v) => (Object.is(v, -0) ? 0 : v)));
      }),
    );
  });

  it.each(['1.', '-.5', '+2', '1e-3', ' 7 '])('numbers in arguments may be written %j', (text) => {
    expect(numberOf('x', text)).toBe(Number(text));
  });

  it.each(['', 'nan', 'Infinity', '0x10', '1e999', '1.5.2', '12x', '1 2', '.', '1_000'])(
    'numbers in arguments are not %j',
    (text) => {
      expect(() => numberOf('x', text)).toThrow(UsageError);
    },
  );

  it('numbers in arguments have nothing missing between commas', () => {
    expect(() => numbersOf('x', '1,,2')).toThrow(UsageError);
    expect(() => numbersOf('x', '1,2,')).toThrow(UsageError);
    expect(numbersOf('x', '')).toEqual([]);
  });
});
