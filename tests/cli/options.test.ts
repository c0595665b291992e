import fc from 'fast-check';
import { expect, expectTypeOf, it } from 'vitest';
import {
  ending,
  type Kind,
  number,
  numbers,
  oneOf,
  point,
  positive,
  readValue,
  whole,
} from '../../src/cli/options/kinds.ts';
import { nearestName } from '../../src/cli/options/nearest-name.ts';
import { flag, option } from '../../src/cli/options/option.ts';
import { parse } from '../../src/cli/options/parse.ts';
import { COMMANDS } from '../../src/cli/run.ts';
import { UsageError } from '../../src/cli/usage-error.ts';
import { command } from '../helpers/command.ts';

const OPTIONS = {
  time: option(number('T'), 'Sets the time.'),
  name: option(oneOf(['walk', 'run']), 'Sets the name.', { default: 'walk' }),
  root: option(point('x,y,z'), 'Sets the root.', { isRepeated: true, needs: 'time' }),
  json: flag('Prints JSON.'),
  csv: flag('Prints CSV.'),
};
const given = (...args: string[]) => parse(args, OPTIONS, [['json', 'csv']]);
const refused = (...args: string[]) => {
  try {
    given(...args);
  } catch (error) {
    if (error instanceof UsageError) return error.message;
  }
  return 'not refused';
};

it('options have the types of their kinds and rules', () => {
  const { options, inputs } = given('a.skel', '--json', 'b c.skin', '--time', '1', 'd.anim');
  expectTypeOf(options).toEqualTypeOf<{
    readonly time: number | undefined;
    readonly name: 'walk' | 'run';
    readonly root: readonly (readonly [number, number, number])[];
    readonly json: boolean;
    readonly csv: boolean;
  }>();
  expect(inputs).toEqual(['a.skel', 'b c.skin', 'd.anim']);
  expect(options).toEqual({ time: 1, name: 'walk', root: [], json: true, csv: false });
});

it('option values follow a blank or an equals sign, and may begin with a minus', () => {
  expect(given('--time', '-1').options.time).toBe(-1);
  expect(given('--time=-2').options.time).toBe(-2);
});

it('everything after -- is an input', () => {
  expect(given('--', '--json', '-x.skel')).toMatchObject({ inputs: ['--json', '-x.skel'], options: { json: false } });
});

it('a repeated option gives its last value, or all of them where it may be repeated', () => {
  const { time, root } = given('--time', 'x', '--root=1,2,3', '--time=2', '--root', '4,5,6').options;
  expect([time, root]).toEqual([
    2,
    [
      [1, 2, 3],
      [4, 5, 6],
    ],
  ]);
});

it.each([
  [['--tiem', '1'], 'There is no option --tiem. Did you mean --time?'],
  [
    ['--constructor', '1'],
    'There is no option --constructor. Its options are --time, --name, --root, --json and --csv.',
  ],
  [['-t'], 'There is no option -t. Its options are --time, --name, --root, --json and --csv.'],
  [['--time'], '--time needs a value: a number.'],
  [['--json=yes'], '--json takes no value.'],
  [['--time', 'noon'], '--time takes a number, found "noon".'],
  [['--time='], '--time takes a number, found "".'],
  [['--name', 'Walk'], '--name takes one of walk, run, found "Walk".'],
  [['--json', '--csv'], 'Give only one of --json and --csv.'],
  [['--root', '1,2,3'], '--root needs --time T.'],
  [['--time', '1', '--root', '1,2'], '--root takes 3 numbers, x,y,z, found "1,2".'],
])('%j is refused in a sentence', (args, sentence) => {
  expect(refused(...args)).toBe(sentence);
});

it('a required option that is missing is named with what it takes', () => {
  const options = { to: option(ending(['npz', 'csv']), 'Sets the kind.', { isRequired: true }) };
  expect(() => parse([], options)).toThrow('--to is missing: one of npz, csv.');
  expectTypeOf(parse(['--to', '.NPZ'], options).options.to).toEqualTypeOf<'npz' | 'csv'>();
  expect(parse(['--to', '.NPZ'], options).options.to).toBe('npz');
});

const read = <T>(kind: Kind<T>, text: string) => readValue(kind, text, '--x');

it('numbers are read back as every double that JS prints', () => {
  fc.assert(
    fc.property(fc.array(fc.double({ noNaN: true, noDefaultInfinity: true })), (values) => {
      expect(read(numbers('x,…'), values.join(','))).toEqual(values.map((v) => (Object.is(v, -0) ? 0 : v)));
    }),
  );
});

it.each(['1.', '-.5', '+2', '1e-3', ' 7 '])('a number may be written %j', (text) => {
  expect(read(number('X'), text)).toBe(Number(text));
});

it.each(['', 'nan', 'Infinity', '0x10', '1e999', '1.5.2', '12x', '1 2', '.', '1_000'])('%j is not a number', (text) => {
  expect(() => read(number('X'), text)).toThrow(UsageError);
});

it('a list of numbers names the one that is none', () => {
  expect(() => read(numbers('x,…'), '1,,2')).toThrow('--x takes numbers, separated by commas, found "".');
  expect(() => read(numbers('x,…'), '1,2b,x')).toThrow('found "2b".');
  expect(read(numbers('x,…'), '')).toEqual([]);
  expect(() => read(numbers('x,…', 1), '')).toThrow('--x takes at least one number, separated by commas, found "".');
});

it('numbers within bounds are refused outside them', () => {
  expect(() => read(positive('X'), '0')).toThrow('--x takes a number greater than 0, found "0".');
  expect(() => read(whole('N', 1, 8), '9')).toThrow('--x takes a whole number from 1 to 8, found "9".');
  expect(() => read(whole('N', 1), '0')).toThrow('--x takes a whole number of at least 1, found "0".');
  expect(() => read(whole('N'), '1.5')).toThrow('--x takes a whole number, found "1.5".');
  expect(read(whole('N', 1, 8), '8')).toBe(8);
});

it('the nearest name is the one with the fewest changes, if these are few', () => {
  const names = ['time', 'times', 'tolerance', 'no-times'];
  const near = ['tims', 'tiems', 'tolerence', 'notimes', 'x', ''].map((name) => nearestName(name, names));
  expect(near).toEqual(['time', 'times', 'tolerance', 'no-times', undefined, undefined]);
});

/** Options of a command's help, by the lines that explain them. */
const explainedIn = (help: string) => [...help.matchAll(/^ {2}--([a-z0-9-]+)/gm)].map(([, name]) => name);

it.each(COMMANDS.map((each) => [each.name, each] as const))(
  'marrow %s --help explains each option once',
  async (name, each) => {
    const { code, out, err } = await command([name, '--help']);
    expect([code, err]).toEqual([0, '']);
    expect(explainedIn(out).toSorted()).toEqual(Object.keys(each.options).toSorted());
    for (const line of out.split('\n').filter((text) => !text.startsWith('  marrow'))) {
      expect(
        line.startsWith('usage') || line.startsWith('       marrow') || line.startsWith('Exit') || line.length <= 100,
        line,
      ).toBe(true);
    }
  },
);

it.each(COMMANDS.map((each) => [each.name, each] as const))('the record of marrow %s is sound', (_, each) => {
  for (const [name, { what, needs }] of Object.entries(each.options)) {
    expect(name).toMatch(/^[a-z][a-z0-9-]*$/);
    // A sentence: the end of another one would be followed by a capital.
    expect(what).toMatch(/^[A-Z].*\.$/);
    expect(what).not.toMatch(/\. [A-Z]/);
    if (needs !== undefined) expect(Object.keys(each.options)).toContain(needs);
  }
  expect(each.summary).toMatch(/^[A-Z].*\.$/);
});

it.each(['x'.repeat(5000), `${'x'.repeat(5000)}=1,2`, '1,'.repeat(5000)])(
  'a long value is refused in a short sentence',
  (long) => {
    for (const { options } of COMMANDS) {
      for (const [name, { read }] of Object.entries(options)) {
        try {
          read([long], `--${name}`);
        } catch (error) {
          if (!(error instanceof UsageError)) throw error;
          expect(error.message.length, name).toBeLessThan(500);
        }
      }
    }
  },
);

it('any arguments are taken, or refused in a sentence and with the usage', () => {
  const names = fc.constantFrom(...COMMANDS.flatMap(({ options }) => Object.keys(options)));
  const option = fc.oneof(names, fc.string(), fc.constantFrom('__proto__', 'toString', '=', ''));
  const value = fc.oneof(
    fc.string(),
    fc.constantFrom('', '-1', '1,2,3', '1/2', 'npz', 'glb', 'hand=1,2,3', '0', 'x'.repeat(5000)),
  );
  const part = fc.oneof(
    option.map((name) => [`--${name}`]),
    fc.tuple(option, value).map(([name, text]) => [`--${name}`, text]),
    fc.tuple(option, value).map(([name, text]) => [`--${name}=${text}`]),
    value.map((text) => [text]),
  );
  fc.assert(
    fc.property(
      fc.constantFrom(...COMMANDS),
      fc.array(part, { maxLength: 6 }),
      ({ name, options, exclusive, inputs }, parts) => {
        try {
          inputs.read(parse(parts.flat(), options, exclusive).inputs, name);
        } catch (error) {
          if (!(error instanceof UsageError)) throw error;
          expect(error.message).toMatch(/^\S.*[.?]$/s);
          expect(error.message.length).toBeLessThan(1000);
        }
      },
    ),
    { numRuns: 2000 },
  );
});
