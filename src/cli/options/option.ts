/**
 * Options of commands of the shell, each declared once, with its explanation:
 *
 *     options: {
 *       time: option(number('T'), 'Poses the character at T seconds of its take.'),
 *       json: flag('Prints the result as JSON.'),
 *     }
 *
 * The types that `run` receives, the parser, and every text about options come from there.
 */
import { type Kind, readValue } from './kinds.ts';

/** What else is said about an option. */
export interface Rules<T> {
  /** Left out, this is its value. */
  readonly default?: T;
  /** It can't be left out. */
  readonly isRequired?: true;
  /** It may be given several times, and has all these values; otherwise the last one counts. */
  readonly isRepeated?: true;
  /** Name of the option without which this one has no effect. */
  readonly needs?: string;
}

/** An option whose value in `run` is a T. */
export interface Option<T> extends Rules<unknown> {
  /** What it does, in one sentence; what its rules say is added. */
  readonly what: string;
  /** Absent: it is a flag, which takes no value. */
  readonly kind?: Pick<Kind<unknown>, 'placeholder' | 'what'>;
  /** Heading that it is listed under; absent: "Options". */
  readonly section?: string;
  /** @param given its values in order, empty texts for a flag @throws UsageError if one doesn't fit */
  read(given: readonly string[], name: string): T;
}

/** Options by their names, without dashes. */
export type Options = Readonly<Record<string, Option<unknown>>>;

/** The values that the options have in `run`. */
export type OptionValues<O extends Options> = {
  readonly [K in keyof O]: O[K] extends Option<infer T> ? T : never;
};

type Read<T, R> = R extends { readonly isRepeated: true }
  ? readonly T[]
  : R extends { readonly isRequired: true } | { readonly default: T }
    ? T
    : T | undefined;

/** An option that takes a value. @param what it does, in a sentence */
export function option<T, const R extends Rules<T> = Rules<T>>(
  kind: Kind<T>,
  what: string,
  rules?: R,
): Option<Read<T, R>> {
  const { default: otherwise, isRepeated }: Rules<T> = rules ?? {};
  const valueIn = (given: readonly string[], name: string): readonly T[] | T | undefined => {
    if (isRepeated) return given.map((text) => readValue(kind, text, name));
    const last = given.at(-1);
    return last === undefined ? otherwise : readValue(kind, last, name);
  };
  return {
    ...rules,
    what,
    kind,
    // By the same rules as its type; the parser has refused a command line without a required one.
    read: (given, name) => valueIn(given, name) as Read<T, R>,
  };
}

/** An option without a value. @param what it does, in a sentence */
export function flag(what: string, rules?: Pick<Rules<boolean>, 'needs'>): Option<boolean> {
  return { ...rules, what, read: (given) => given.length > 0 };
}

/** The same options, listed under a heading. */
export function section<const O extends Options>(heading: string, options: O): O {
  const listed = Object.entries(options).map(([name, each]) => [name, { ...each, section: heading }]);
  // The same names, with options that read the same.
  return Object.fromEntries(listed) as O;
}
