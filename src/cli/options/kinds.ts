/** Kinds of values that options take. Each says how it is written, in usage, and what it must be, in errors. */
import { cutText } from '../../model/names/cut-text.ts';
import { UsageError } from '../usage-error.ts';

/** Refuses a value. @param found what doesn't fit, default all of it @throws UsageError */
export type Misfit = (found?: string) => never;

export interface Kind<T> {
  /** Stands for the value in usage and help: `T,T,…`. */
  readonly placeholder: string;
  /** In words, to end "--times takes": `numbers, separated by commas`. */
  readonly what: string;
  /** The value of a text. Throws what `misfit` throws, or a `UsageError` of its own. */
  read(text: string, misfit: Misfit): T;
}

/**
 * @param name the option, `--time`
 * @throws UsageError that says what the option takes, if the text is of another kind
 */
export function readValue<T>({ what, read }: Kind<T>, text: string, name: string): T {
  return read(text, (found = text) => {
    throw new UsageError(`${name} takes ${what}, found "${cutText(found)}".`);
  });
}

/** Any text, such as a path. @param what it names: `a folder` */
export function text(placeholder: string, what: string): Kind<string> {
  return { placeholder, what, read: (given) => given };
}

/** A finite number. */
export function number(placeholder: string): Kind<number> {
  return numberKind(placeholder, 'a number', () => true);
}

/** A number greater than 0. */
export function positive(placeholder: string): Kind<number> {
  return numberKind(placeholder, 'a number greater than 0', (value) => value > 0);
}

/** A whole number within these bounds, each included. */
export function whole(placeholder: string, from = -Infinity, to = Infinity): Kind<number> {
  const range = to < Infinity ? ` from ${from} to ${to}` : from > -Infinity ? ` of at least ${from}` : '';
  const fits = (value: number) => Number.isInteger(value) && value >= from && value <= to;
  return numberKind(placeholder, `a whole number${range}`, fits);
}

function numberKind(placeholder: string, what: string, fits: (value: number) => boolean): Kind<number> {
  return {
    placeholder,
    what,
    read(given, misfit) {
      const value = numberOf(given);
      return value !== undefined && fits(value) ? value : misfit();
    },
  };
}

/** Numbers separated by commas. @param least fewer are refused; an empty text has none */
export function numbers(placeholder: string, least = 0): Kind<readonly number[]> {
  return {
    placeholder,
    what: `${least > 0 ? 'at least one number' : 'numbers'}, separated by commas`,
    read(given, misfit) {
      const values = given.trim() === '' ? [] : given.split(',').map((part) => numberOf(part) ?? misfit(part));
      return values.length < least ? misfit() : values;
    },
  };
}

/** The three coordinates of a point. */
export function point(placeholder: string): Kind<readonly [number, number, number]> {
  const { read } = numbers(placeholder);
  return {
    placeholder,
    what: `3 numbers, ${placeholder}`,
    read(given, misfit) {
      const [x, y, z, ...others] = read(given, misfit);
      return x === undefined || y === undefined || z === undefined || others.length > 0 ? misfit() : [x, y, z];
    },
  };
}

/** One of several words. */
export function oneOf<const T extends string>(words: readonly T[]): Kind<T> {
  return {
    placeholder: words.join('|'),
    what: `one of ${words.join(', ')}`,
    read: (given, misfit) => words.find((word) => word === given) ?? misfit(),
  };
}

/** One of several kinds of files, named as such files end: `npz`, `.npz` or `NPZ`. */
export function ending<const T extends string>(endings: readonly T[]): Kind<T> {
  const { read, ...rest } = oneOf(endings);
  return { ...rest, read: (given, misfit) => read(given.replace(/^\./, '').toLowerCase(), () => misfit()) };
}

/** Decimal, as in the files: no hex, no infinity, nothing after the number. */
const NUMBER = /^[+-]?(\d+(?:\.\d*)?|\.\d+)(e[+-]?\d+)?$/i;

function numberOf(given: string): number | undefined {
  const value = NUMBER.test(given.trim()) ? Number(given) : Number.NaN;
  return Number.isFinite(value) ? value : undefined;
}
