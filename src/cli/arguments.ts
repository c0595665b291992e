/**
 * Arguments of the command: `marrow COMMAND FILE… --name value --name=value --flag`.
 *
 * An option that takes a value takes the next argument whatever it begins with, so `--time -1` needs no quoting; after
 * `--` everything is a file. Node's own `parseArgs` calls a value with a minus ambiguous and refuses it.
 */

/** Wrong usage: exit code 2. The message is a whole sentence. */
export class UsageError extends Error {
  override readonly name = 'UsageError';
}

/** What a command accepts: `value` options take one, `flag`s don't. */
export type OptionTypes = Readonly<Record<string, 'value' | 'flag'>>;

export interface Arguments {
  readonly files: readonly string[];
  /** The option's last value; undefined if it wasn't given. */
  value(name: string): string | undefined;
  /** All values of the option, in order; empty if it wasn't given. */
  values(name: string): readonly string[];
  flag(name: string): boolean;
}

/** @throws UsageError if an option is unknown, has no value, or is a flag with a value */
export function parseArguments(args: readonly string[], types: OptionTypes): Arguments {
  const files: string[] = [];
  const values = new Map<string, string[]>();
  const give = (name: string, value: string) => values.set(name, [...(values.get(name) ?? []), value]);
  const flags = new Set<string>();
  for (let i = 0; i < args.length; i++) {
    const arg = args[i];
    if (arg === '--') {
      files.push(...args.slice(i + 1));
      break;
    }
    if (!arg.startsWith('-') || arg === '-') {
      files.push(arg);
      continue;
    }
    const equals = arg.indexOf('=');
    const option = equals < 0 ? arg : arg.slice(0, equals);
    const name = option.startsWith('--') ? option.slice(2) : '';
    const type = Object.hasOwn(types, name) ? types[name] : undefined;
    if (type === undefined) throw new UsageError(`There is no option ${option}.${hint(types)}`);
    if (type === 'flag') {
      if (equals >= 0) throw new UsageError(`${option} takes no value.`);
      flags.add(name);
    } else if (equals >= 0) give(name, arg.slice(equals + 1));
    else if (i + 1 < args.length) give(name, args[++i]);
    else throw new UsageError(`${option} needs a value.`);
  }
  return {
    files,
    value: (name) => values.get(name)?.at(-1),
    values: (name) => values.get(name) ?? [],
    flag: (name) => flags.has(name),
  };
}

function hint(types: OptionTypes): string {
  const names = Object.keys(types).map((name) => `--${name}`);
  return names.length ? ` Options: ${names.join(', ')}.` : '';
}

/** Decimal, as in the files: no hex, no infinity, nothing after the number. */
const NUMBER = /^[+-]?(\d+(?:\.\d*)?|\.\d+)(e[+-]?\d+)?$/i;

/** @throws UsageError unless the text is a number that a double can hold */
export function numberOf(option: string, text: string): number {
  const value = NUMBER.test(text.trim()) ? Number(text) : Number.NaN;
  if (!Number.isFinite(value)) throw new UsageError(`--${option} takes numbers; found "${text}".`);
  return value;
}

/** Numbers separated by commas; an empty text has none. @throws UsageError */
export function numbersOf(option: string, text: string): number[] {
  return text.trim() === '' ? [] : text.split(',').map((part) => numberOf(option, part));
}
