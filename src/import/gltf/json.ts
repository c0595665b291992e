/** The JSON of a glTF file, which may hold anything: values by name, each checked where it is used. */
import { ImportError } from '../imported.ts';

/** An object of the file. */
export type Json = Readonly<Record<string, unknown>>;

/** The value as an object; undefined if it is none, or a list. */
export function objectOf(value: unknown): Json | undefined {
  // Any object that is no list has names and values.
  return typeof value === 'object' && value !== null && !Array.isArray(value) ? (value as Json) : undefined;
}

/** The value as a list; empty if it is none. */
export function listOf(value: unknown): readonly unknown[] {
  return Array.isArray(value) ? value : [];
}

/** The value as text; undefined if it is none. */
export function textOf(value: unknown): string | undefined {
  return typeof value === 'string' ? value : undefined;
}

/** The value as a finite number; undefined if it is none. */
export function numberOf(value: unknown): number | undefined {
  return typeof value === 'number' && Number.isFinite(value) ? value : undefined;
}

/** A whole number of at least 0. */
export function countOf(value: unknown): number | undefined {
  return typeof value === 'number' && Number.isSafeInteger(value) && value >= 0 ? value : undefined;
}

/** Any value of the file, for messages. */
export function shown(value: unknown): string {
  return value === undefined ? 'nothing' : JSON.stringify(value);
}

/** Exactly so many finite numbers; undefined otherwise. */
export function numbersOf(value: unknown, count: number): readonly number[] | undefined {
  const list = listOf(value);
  return list.length === count && list.every((n) => numberOf(n) !== undefined)
    ? (list as readonly number[])
    : undefined;
}

/** The extension of that name of an object. */
export function extensionOf(object: Json | undefined, name: string): Json | undefined {
  return objectOf(objectOf(object?.extensions)?.[name]);
}

/** A whole file: lists of objects that refer to each other by index. */
export class Document {
  constructor(readonly root: Json) {}

  /** The objects of one kind; those that are none are empty. */
  all(kind: string): readonly Json[] {
    return listOf(this.root[kind]).map((item) => objectOf(item) ?? {});
  }

  /** Number of entries in one of the file's lists, such as `nodes`; 0 without the list. */
  count(kind: string): number {
    return listOf(this.root[kind]).length;
  }

  /**
   * The object of an index; its absence is an error.
   * @param where what refers to it: `node 3`
   */
  at(kind: string, index: unknown, where: string): Json {
    const found = countOf(index) === undefined ? undefined : objectOf(listOf(this.root[kind])[Number(index)]);
    if (found) return found;
    const message = `${where} refers to ${kind} ${shown(index)}; the file has ${this.count(kind)} of them, counted from 0.`;
    throw new ImportError('index-out-of-range', message);
  }
}
