/**
 * JSON files of our own: values that know their path, by which messages name them, and fields that are not known, which
 * are told and kept. The first value that doesn't fit is the error, and the file counts as absent.
 *
 *     jsonReader(fileName, 'sets-wrong', (file) => {
 *       const object = file.object();
 *       const name = object.field('name').text();          // sets-wrong: name: expected text, found 3.
 *       const joints = object.optional('joints')?.list().map((joint) => joint.text());
 *       return { name, joints, ...object.others() };       // last: what was not asked for
 *     })
 */
import type { OtherFields } from '../../model/other-fields.ts';
import { type Place, WHOLE_FILE } from '../places.ts';
import { bytesReader, type Reader } from '../reader.ts';
import { ParseError, type Report } from '../report.ts';

/** Values within values; more than any of these files needs, few enough for every function that walks through them. */
const DEEPEST = 64;

/**
 * A reader of a file of ours in JSON.
 *
 * @param read may only throw what the values of the file throw
 * @param code of the error about a value that doesn't fit
 */
export function jsonReader<T>(fileName: string, code: string, read: (file: JsonValue, report: Report) => T): Reader<T> {
  return bytesReader(fileName, (bytes, report) => read(new JsonValue(parsed(bytes, report), '', code, report), report));
}

function parsed(bytes: Uint8Array, report: Report): unknown {
  const text = new TextDecoder().decode(bytes);
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    fail(report, 'json-wrong', `Expected JSON: ${why}`, placeIn(text, why));
  }
  if (isDeeper(value, DEEPEST)) {
    const message = `Expected values within values up to ${DEEPEST} times, found more.`;
    fail(report, 'json-wrong', message, WHOLE_FILE);
  }
  return value;
}

function fail(report: Report, code: string, message: string, place: Place): never {
  report.error(code, message, place);
  throw new ParseError(message);
}

/** The place that the message of a parser names: V8 counts characters, Firefox lines and columns. */
function placeIn(text: string, message: string): Place {
  const [, line, column] = /line (\d+) column (\d+)/.exec(message) ?? [];
  if (line !== undefined) return { line: Number(line), column: Number(column) };
  const [, at] = /position (\d+)/.exec(message) ?? [];
  if (at === undefined) return WHOLE_FILE;
  const before = text.slice(0, Number(at)).split('\n');
  return { line: before.length, column: (before.at(-1)?.length ?? 0) + 1 };
}

function isDeeper(value: unknown, depth: number): boolean {
  if (typeof value !== 'object' || value === null) return false;
  return depth === 0 || Object.values(value).some((inner) => isDeeper(inner, depth - 1));
}

/** A value of a file, at its path. */
export class JsonValue {
  /** @param path within the file: `sets[0].joints`; empty for all of it */
  constructor(
    private readonly value: unknown,
    readonly path: string,
    private readonly code: string,
    private readonly report: Report,
  ) {}

  /** The value as text. @throws ParseError, which is reported, for another one; so do the other functions */
  text(): string {
    return typeof this.value === 'string' ? this.value : this.wrong('text');
  }

  /** The value as a finite number. @param expected in words, of a value that may be something else, too */
  number(expected = 'a finite number'): number {
    return typeof this.value === 'number' && Number.isFinite(this.value) ? this.value : this.wrong(expected);
  }

  /** The value as one of several words. */
  word<W extends string>(words: readonly W[]): W {
    return words.find((word) => word === this.value) ?? this.wrong(words.join(' or '));
  }

  /** Whether the value is text. */
  isText(): boolean {
    return typeof this.value === 'string';
  }

  /** Whether the value is an object, which `object` takes. */
  isObject(): boolean {
    return typeof this.value === 'object' && this.value !== null && !Array.isArray(this.value);
  }

  /** The value as true or false. */
  boolean(): boolean {
    return typeof this.value === 'boolean' ? this.value : this.wrong('true or false');
  }

  /** The items of a list. */
  list(): readonly JsonValue[] {
    if (!Array.isArray(this.value)) return this.wrong('a list');
    return this.value.map((item, i) => this.at(item, `${this.path}[${i}]`));
  }

  /** The fields of an object. */
  object(): JsonObject {
    const { value } = this;
    if (typeof value !== 'object' || value === null || Array.isArray(value)) return this.wrong('an object');
    return new JsonObject(value, this, (field, path) => this.at(field, path), this.report);
  }

  /** Reports that the value is not what was expected. @param expected in words: `a list` */
  wrong(expected: string): never {
    const found = this.value === undefined ? 'nothing' : described(this.value);
    const where = this.path === '' ? '' : `${this.path}: `;
    const message = `${where}expected ${expected}, found ${found}.`;
    return fail(this.report, this.code, where ? message : `E${message.slice(1)}`, WHOLE_FILE);
  }

  private at(value: unknown, path: string): JsonValue {
    return new JsonValue(value, path, this.code, this.report);
  }
}

/** The fields of an object, each asked for by its name. */
export class JsonObject {
  private readonly asked = new Set<string>();

  /** Made by `JsonValue`. */
  constructor(
    private readonly fields: object,
    private readonly of: JsonValue,
    private readonly at: (value: unknown, path: string) => JsonValue,
    private readonly report: Report,
  ) {}

  /** A field that there must be: the error about its absence is of its first use. */
  field(name: string): JsonValue {
    this.asked.add(name);
    const value: unknown = Object.hasOwn(this.fields, name) ? Reflect.get(this.fields, name) : undefined;
    return this.at(value, this.pathOf(name));
  }

  /** A field that may be left out, then undefined. */
  optional(name: string): JsonValue | undefined {
    const field = this.field(name);
    return Object.hasOwn(this.fields, name) ? field : undefined;
  }

  /** The fields that were not asked for, each told; a field `others` of the result, absent without any. */
  others(): { readonly others?: OtherFields } {
    const left = Object.entries(this.fields).filter(([name]) => !this.asked.has(name) && name !== '__proto__');
    for (const [name] of left) {
      this.report.info('field-unknown', `${this.pathOf(name)} is not known here.`, WHOLE_FILE, 'kept as it is');
    }
    return left.length > 0 ? { others: Object.fromEntries(left) } : {};
  }

  private pathOf(name: string): string {
    return this.of.path === '' ? name : `${this.of.path}.${name}`;
  }
}

/** In words that stay short. */
function described(value: unknown): string {
  if (Array.isArray(value)) return `a list of ${value.length}`;
  if (typeof value === 'object' && value !== null) return 'an object';
  return JSON.stringify(value);
}
