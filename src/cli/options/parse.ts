/**
 * Arguments of a command: `marrow COMMAND FILE… --name value --name=value --flag`.
 *
 * An option that takes a value takes the next argument whatever it begins with, so `--time -1` needs no quoting; after
 * `--` everything is an input. Node's own `parseArgs` calls a value with a minus ambiguous and refuses it.
 */
import { cutText } from '../../model/names/cut-text.ts';
import { UsageError } from '../usage-error.ts';
import { nearestName } from './nearest-name.ts';
import type { Option, Options, OptionValues } from './option.ts';

export interface Parsed<O extends Options> {
  /** What is not an option: files and folders. */
  readonly inputs: readonly string[];
  readonly options: OptionValues<O>;
}

/** Options of which at most one may be given. */
export type Exclusive<O extends Options> = readonly (readonly (keyof O & string)[])[];

/** @throws UsageError if an option is unknown, missing, of another kind, or doesn't go with the others */
export function parse<O extends Options>(args: readonly string[], options: O, exclusive: Exclusive<O> = []): Parsed<O> {
  const { inputs, given } = split(args, options);
  for (const names of exclusive) {
    if (names.filter((name) => given.has(name)).length > 1) throw new UsageError(`Give only one of ${listed(names)}.`);
  }
  for (const [name, { needs, isRequired, kind }] of Object.entries(options)) {
    if (needs !== undefined && given.has(name) && !given.has(needs)) {
      throw new UsageError(`--${name} needs ${written(needs, options[needs])}.`);
    }
    if (isRequired && !given.has(name)) throw new UsageError(`--${name} is missing: ${kind?.what}.`);
  }
  const values = Object.entries(options).map(([name, { read }]) => [name, read(given.get(name) ?? [], `--${name}`)]);
  // Each was read by its option.
  return { inputs, options: Object.fromEntries(values) as OptionValues<O> };
}

/** An option as it is written: `--time T`. */
export function written(name: string, { kind }: Option<unknown>): string {
  return kind ? `--${name} ${kind.placeholder}` : `--${name}`;
}

/** Inputs, and the values of each option that is given. @throws UsageError */
function split(args: readonly string[], options: Options) {
  const inputs: string[] = [];
  const given = new Map<string, string[]>();
  for (let i = 0; i < args.length; i++) {
    const arg = args[i];
    if (arg === '--') {
      inputs.push(...args.slice(i + 1));
      break;
    }
    if (!arg.startsWith('-') || arg === '-') {
      inputs.push(arg);
      continue;
    }
    const equals = arg.indexOf('=');
    const called = equals < 0 ? arg : arg.slice(0, equals);
    const name = called.startsWith('--') ? called.slice(2) : '';
    if (!Object.hasOwn(options, name)) throw unknown(called, options);
    const { kind } = options[name];
    if (!kind && equals >= 0) throw new UsageError(`${called} takes no value.`);
    if (kind && equals < 0 && i + 1 === args.length) throw new UsageError(`${called} needs a value: ${kind.what}.`);
    const value = !kind ? '' : equals >= 0 ? arg.slice(equals + 1) : args[++i];
    given.set(name, [...(given.get(name) ?? []), value]);
  }
  return { inputs, given };
}

function unknown(called: string, options: Options): UsageError {
  const names = Object.keys(options);
  const nearest = nearestName(called.replace(/^-+/, ''), names);
  const hint = nearest === undefined ? `Its options are ${listed(names)}.` : `Did you mean --${nearest}?`;
  return new UsageError(`There is no option ${cutText(called)}. ${hint}`);
}

/** `--time, --times and --frame` */
function listed(names: readonly string[]): string {
  const all = names.map((name) => `--${name}`);
  return all.length < 2 ? all.join() : `${all.slice(0, -1).join(', ')} and ${all.at(-1)}`;
}
