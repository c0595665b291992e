/**
 * Shapes of command arguments that come from scripts: each checks a value and copies it to plain data of its own, so
 * that what a command gets has no getters, no proxies and no surprises in its prototype. What doesn't fit is refused in
 * a sentence with its place: `"dofs[0].index" must be a whole number from 0, found "length".`
 *
 *     const SET = record({ characterId: text, dofs: list(record({ index, value: number })) });
 *     SET.read(given, '')        // the copy, or a CommandError
 *     SET.what                   // { characterId: text, dofs: list of { index: … } }
 *
 * (Rejected: valibot and zod. Both copy, but words like these would have to be given for each of their checks.)
 */
import { described } from '../arguments.ts';
import { CommandError } from '../command-error.ts';
import { givenName } from './old-names.ts';

/** The shape of a value: checks it, copies it, and says what it must be. */
export interface Shape<T> {
  /** In words: `a finite number`. */
  readonly what: string;
  /** May be left out where it is a field. */
  readonly isOptional?: true;
  /** Where it is left out, the time and range of the page don't take its place. */
  readonly hasNoDefault?: true;
  /**
   * A copy of the value.
   * @param path of the value within the arguments: `dofs[0].index`
   * @param strange what happens to fields that are not known
   * @throws CommandError for a value of another shape
   */
  read(value: unknown, path: string, strange?: StrangeFields): T;
}

/** Scripts are told of them, since they are mistyped (the default); the page may give more than is asked for. */
export type StrangeFields = 'refused' | 'left out';

/** The type of values of a shape. */
export type Shaped<S> = S extends Shape<infer T> ? T : never;

/** No list of arguments is longer: a length alone can ask for billions. */
const MAX_ITEMS = 2 ** 24;
/** Characters of a text. */
const LONGEST_TEXT = 2 ** 20;

/**
 * The error for a value that doesn't fit.
 * @param path of the value within the arguments; empty for all of them
 * @param what the value must be, in words
 */
export function misfit(path: string, what: string, value: unknown): CommandError {
  return new CommandError(`${path === '' ? 'The arguments' : `"${path}"`} must be ${what}, found ${described(value)}.`);
}

/** A value that is taken as it is if it fits. @param what it must be, in words */
export function shape<T>(what: string, fits: (value: unknown) => value is T): Shape<T> {
  return {
    what,
    read(value, path) {
      if (fits(value)) return value;
      throw misfit(path, what, value);
    },
  };
}

/** A finite number. */
export const number: Shape<number> = shape('a finite number', (value): value is number => Number.isFinite(value));
/** True or false. */
export const boolean: Shape<boolean> = shape('true or false', (value) => typeof value === 'boolean');
/** May be empty; commands that need a name say so. */
export const text: Shape<string> = shape(
  `text of up to ${LONGEST_TEXT.toLocaleString('en')} characters`,
  (value): value is string => typeof value === 'string' && value.length <= LONGEST_TEXT,
);

/** As the name of something new. */
export const filledText: Shape<string> = shape(
  `text that isn’t blank, of up to ${LONGEST_TEXT.toLocaleString('en')} characters`,
  (value): value is string => typeof value === 'string' && value.length <= LONGEST_TEXT && value.trim() !== '',
);

/** A whole number; −0 is 0. */
export function whole(from: number): Shape<number> {
  const what = `a whole number from ${from}`;
  return {
    what,
    read(value, path) {
      if (typeof value === 'number' && Number.isSafeInteger(value) && value >= from) return value + 0;
      throw misfit(path, what, value);
    },
  };
}

/** Index of joints, channels, keys and the like. */
export const index: Shape<number> = whole(0);

/** One of a list of words or numbers. */
export function oneOf<const T extends string | number>(values: readonly T[]): Shape<T> {
  const what = `one of ${values.map((value) => JSON.stringify(value)).join(', ')}`;
  return shape(what, (value): value is T => values.some((one) => one === value));
}

/** A value of one of two shapes, tried in this order. */
export function either<A, B>(a: Shape<A>, b: Shape<B>): Shape<A | B> {
  const what = `${a.what}, or ${b.what}`;
  return {
    what,
    read(value, path, strange) {
      for (const one of [a, b]) {
        try {
          return one.read(value, path, strange);
        } catch (error) {
          if (!(error instanceof CommandError)) throw error;
        }
      }
      throw misfit(path, what, value);
    },
  };
}

/** A value of a shape, or null. */
export function nullable<T>(of: Shape<T>): Shape<T | null> {
  return {
    what: `${of.what}, or null`,
    read: (value, path, strange) => (value === null ? null : of.read(value, path, strange)),
  };
}

/** A field that may be left out; undefined leaves it out. */
export function optional<T>(of: Shape<T>): Shape<T> & { readonly isOptional: true } {
  return { ...of, isOptional: true };
}

/** One whose absence means something: that a time stays as it is. */
export function ifGiven<T>(of: Shape<T>): Shape<T> & { readonly isOptional: true } {
  return { ...of, isOptional: true, hasNoDefault: true };
}

/** A list of values of one shape. */
export function list<T>(of: Shape<T>): Shape<readonly T[]> {
  const what = `a list, each ${of.what}`;
  return {
    what,
    read: (value, path, strange) =>
      itemsOf(value, path, what).map((item, i) => of.read(item, `${path}[${i}]`, strange)),
  };
}

/** So many numbers as there are names: x, y and z. */
export function tuple<const N extends readonly string[]>(...names: N): Shape<{ readonly [I in keyof N]: number }> {
  const what = `a list of ${names.length} finite numbers: ${names.join(', ')}`;
  return {
    what,
    read(value, path) {
      const items = itemsOf(value, path, what);
      if (items.length !== names.length) throw misfit(path, what, value);
      const numbers = items.map((item, i) => number.read(item, `${path}[${i}]`));
      // One for each name, as was checked.
      return numbers as unknown as { readonly [I in keyof N]: number };
    },
  };
}

/** The items of a list without holes. Nothing but its length and its items is read. */
function itemsOf(value: unknown, path: string, what: string): readonly unknown[] {
  if (!Array.isArray(value)) throw misfit(path, what, value);
  const { length } = value;
  if (length > MAX_ITEMS) {
    throw misfit(path, `a list of at most ${MAX_ITEMS.toLocaleString('en')} items`, value);
  }
  const items: unknown[] = [];
  for (let i = 0; i < length; i++) {
    if (!Object.hasOwn(value, i)) throw misfit(`${path}[${i}]`, 'there', undefined);
    items.push(value[i]);
  }
  return items;
}

/** A column of numbers: a typed array, copied. */
export const doubles: Shape<Float64Array> = column('a Float64Array of finite numbers', (value) =>
  value instanceof Float64Array && value.every(Number.isFinite) ? value : undefined,
);
/** A Uint8Array, copied. */
export const bytes: Shape<Uint8Array> = column('a Uint8Array', (value) =>
  value instanceof Uint8Array ? value : undefined,
);

function column<T extends Float64Array | Uint8Array>(what: string, of: (value: unknown) => T | undefined): Shape<T> {
  return {
    what,
    read(value, path) {
      const found = of(value);
      if (!found) throw misfit(path, what, value);
      // The same type of array.
      return found.slice() as T;
    },
  };
}

/** The shapes of an object's fields, by name. */
export type Fields = Readonly<Record<string, Shape<unknown>>>;

type OptionalNames<F extends Fields> = {
  [K in keyof F]: F[K] extends { readonly isOptional: true } ? K : never;
}[keyof F];

/** An object with these fields. */
export type Shapes<F extends Fields> = {
  readonly [K in Exclude<keyof F, OptionalNames<F>>]: Shaped<F[K]>;
} & { readonly [K in OptionalNames<F>]?: Shaped<F[K]> };

/** The values of a record's fields as callers give them: undefined, too, leaves a field out. */
export type Given<F extends Fields> = {
  readonly [K in Exclude<keyof F, OptionalNames<F>>]: Shaped<F[K]>;
} & { readonly [K in OptionalNames<F>]?: Shaped<F[K]> };

/** An object with these fields, all its own. */
export function record<const F extends Fields>(fields: F): Shape<Shapes<F>> {
  const names = Object.keys(fields);
  const what = `{ ${names.map((name) => `${name}${fields[name].isOptional ? '?' : ''}: ${fields[name].what}`).join('; ')} }`;
  return {
    what,
    read(value, path, strange = 'refused') {
      if (typeof value !== 'object' || value === null || Array.isArray(value)) throw misfit(path, what, value);
      const under = (name: string) => (path === '' ? name : `${path}.${name}`);
      const isKnown = (given: string) =>
        Object.hasOwn(fields, given) || names.some((name) => givenName(value, name) === given);
      const unknown = strange === 'refused' && Object.keys(value).find((name) => !isKnown(name));
      if (unknown) {
        throw new CommandError(`"${under(unknown)}" is not known here; expected ${names.join(', ') || 'nothing'}.`);
      }
      const found: Record<string, unknown> = {};
      for (const name of names) {
        const given = givenName(value, name);
        // Only fields of its own: a prototype may bring any.
        const field: unknown = Object.hasOwn(value, given) ? Reflect.get(value, given) : undefined;
        const of = fields[name];
        if (field === undefined && of.isOptional) continue;
        found[name] = of.read(field, under(name), strange);
      }
      // Each field was read by its shape.
      return found as Shapes<F>;
    },
  };
}
