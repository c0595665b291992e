/**
 * Dumps as JSON: what `marrow pose --json` and `marrow channels --json` print, or any object with `time`, `world`,
 * `local`, `positions`, `vertices`, `normals`, `channels`, however deep; or lists of numbers alone. One text, or one
 * per line. Python's dicts are read too.
 *
 *     matrices    16 numbers, or rows of numbers, or { elements }; in a list, by name, or of the items of a list
 *     points      [x, y, z], { x, y, z }, or all numbers in one list
 *     targets     { joint, position, point } each, beside `oneStep: true`; or a position by name (`targets.ts`)
 *     channels    a list per channel with `times` beside it; or items of { time, values }
 */
import type { DumpKind, DumpLabel } from '../../model/dump.ts';
import { lastDigitsIn } from '../../model/names/numbered-names.ts';
import type { Blocks } from './blocks.ts';
import { linesOf } from './numbers.ts';
import { targetsOf } from './targets.ts';

/** Objects within objects that are searched. */
const MAX_DEPTH = 8;
/** Number of keys searched, of those that name numbers, whose lines are looked for. */
const MAX_KEYS = 16;
const LF = 10;

type Json = Readonly<Record<string, unknown>>;

/**
 * Reads a dump in JSON into `blocks`.
 * @returns whether the text is JSON; nothing was read if not
 */
export function readJson(text: string, blocks: Blocks): boolean {
  if (!/^\s*[[{]/.test(text)) return false;
  const whole = parse(text);
  if (whole) new JsonDump(text, 1, blocks).find(whole.value, 0);
  return whole !== undefined || readLines(text, blocks);
}

/** One text per line, each read before the next: a list of all would take many times their bytes. */
function readLines(text: string, blocks: Blocks): boolean {
  let line = 0;
  for (const part of linesOf(text)) {
    line++;
    if (part.trim() === '') continue;
    const one = /^\s*[[{]/.test(part) ? parse(part) : undefined;
    if (!one) {
      blocks.forget();
      return false;
    }
    new JsonDump(part, line, blocks).find(one.value, 0);
  }
  return true;
}

function parse(text: string): { readonly value: unknown } | undefined {
  return parsed(text) ?? parsed(withoutNaN(text)) ?? parsed(withoutNaN(fromPython(text)));
}

/** Strings in single quotes, tuples, numpy's arrays, and commas behind the last item. */
function fromPython(text: string): string {
  return text
    .replaceAll("'", '"')
    .replace(/\b(?:np\.)?array(?=\()|,\s*dtype=(?:np\.)?\w{1,16}(?=\))/g, '')
    .replace(/[()]/g, (bracket) => (bracket === '(' ? '[' : ']'))
    .replace(/,\s*(?=[\]}])/g, '');
}

function withoutNaN(text: string): string {
  return text.replace(/([[,:\s])[-+]?(?:NaN|nan|Infinity|inf|None)(?=[\],}\s])/g, '$1null');
}

function parsed(text: string): { value: unknown } | undefined {
  try {
    return { value: JSON.parse(text) };
  } catch {
    return undefined;
  }
}

const KEYS: readonly (readonly [RegExp, DumpKind])[] = [
  [/^(world|global)(matrix|matrices|transforms?)?$/, 'world'],
  [/^local(matrix|matrices|transforms?)?$/, 'local'],
  [/^(joint)?positions?$/, 'positions'],
  [/^(skin)?(vertices|vertexpositions|verts)$/, 'vertices'],
  [/^(vertex)?normals?$/, 'normals'],
  [/^channels?$/, 'channels'],
];

function kindOfKey(key: string): DumpKind | undefined {
  const plain = key.toLowerCase().replace(/[^a-z]/g, '');
  return KEYS.find(([pattern]) => pattern.test(plain))?.[1];
}

class JsonDump {
  /** Lines of keys, from 1. */
  private readonly lines = new Map<string, number>();

  /** @param line of the text's beginning, from 1 */
  constructor(
    private readonly text: string,
    private readonly line: number,
    private readonly blocks: Blocks,
  ) {}

  /** Reads every list under a key that names a kind. */
  find(value: unknown, depth: number): void {
    if (depth > MAX_DEPTH) return;
    if (Array.isArray(value)) {
      if (value.every(isObject)) {
        this.items(value, depth);
        return;
      }
      if (depth === 0) this.list(undefined, value, this.line);
      return;
    }
    if (!isObject(value)) return;
    const time = [value.time, value.t].find(isNumber);
    if (time !== undefined) this.blocks.say({ time });
    const keys = Object.keys(value);
    if (depth === 0 && keys.length > 0 && !keys.some(kindOfKey) && Object.values(value).every(isOne)) {
      this.list(undefined, value, this.line);
      return;
    }
    const joints = hasJoints(value);
    for (const [key, inside] of Object.entries(value)) {
      const kind = kindOfKey(key);
      if (this.ofSolver(key, inside)) continue;
      if (kind === 'channels') this.channels(inside, value);
      // What stands beside the joints of a character are its vertices, as `marrow pose` prints them.
      else if (kind && isList(inside))
        this.list(joints && kind === 'positions' ? 'vertices' : kind, inside, this.lineOf(key));
      else if (key !== 'diagnostics') this.find(inside, depth + 1);
    }
  }

  /** Whether a key says what a solver of inverse kinematics was to do. */
  private ofSolver(key: string, value: unknown): boolean {
    const plain = key.toLowerCase().replace(/[^a-z]/g, '');
    if (/^(onestep|steps|iterations)$/.test(plain) && (value === true || value === 1)) this.blocks.isOneStep = true;
    const targets = /^(ik)?(targets?|goals?)$/.test(plain) ? targetsOf(value) : undefined;
    for (const target of targets ?? []) this.blocks.target(target, this.lineOf(key));
    return targets !== undefined;
  }

  /** Items such as joints: each kind of numbers that they have, in their order. Others are searched. */
  private items(items: readonly Json[], depth: number): void {
    const keys = new Map<string, DumpKind | undefined>();
    for (const item of items.slice(0, 4)) {
      for (const key of Object.keys(item)) {
        const kind = kindOfKey(key) ?? (key === 'matrix' || key === 'elements' ? 'world' : undefined);
        const inside = item[key];
        if (kind && kind !== 'channels' && isOne(inside)) keys.set(key, kind === 'vertices' ? 'positions' : kind);
      }
    }
    if (this.timed(items)) return;
    if (keys.size === 0 && items.every((item) => pointOf(item))) {
      this.blocks.say({ holds: undefined });
      for (const item of items) this.row(item, this.line, labelOf(item));
      return;
    }
    // Frames of a take have a time each, characters have joints; joints have neither.
    if (keys.size === 0 || items.some((item) => isNumber(item.time) || hasJoints(item))) {
      for (const item of items) this.find(item, depth + 1);
      return;
    }
    for (const [key, kind] of keys) {
      // A position per item is that of a joint or of a vertex; their number tells.
      this.blocks.say({ holds: kind });
      for (const item of items) this.row(item[key], this.lineOf(key), labelOf(item));
    }
  }

  /** Items of a time and the values of all channels. @returns whether they are */
  private timed(items: readonly unknown[]): boolean {
    const rows = items.map((item) => {
      const values = isObject(item) && isNumber(item.time) ? valuesOf(item) : undefined;
      return values && isObject(item) ? [Number(item.time), ...values] : undefined;
    });
    if (rows.length === 0 || !rows.every((row) => row !== undefined)) return false;
    this.blocks.say({ holds: 'channels', times: undefined, time: undefined });
    for (const row of rows) this.blocks.row(row, this.line);
    return true;
  }

  /** Matrices or points. */
  private list(holds: DumpKind | undefined, list: unknown, line: number): void {
    this.blocks.say({ holds, nesting: undefined, times: undefined });
    if (Array.isArray(list)) {
      if (list.every(isNumberOrNull)) this.row(list, line, null);
      else for (const item of list) this.row(item, line, isObject(item) ? labelOf(item) : null);
    } else if (isObject(list)) {
      for (const [name, item] of Object.entries(list))
        this.row(item, line, /^\d+$/.test(name) ? { index: Number(name) } : { name });
    }
  }

  private row(item: unknown, line: number, label: DumpLabel | null): void {
    const isPlain = isNumbers(item);
    const numbers = isPlain ? item : [];
    const isNested = !isPlain && flatten(item, numbers);
    if (numbers.length === 0) return;
    if (numbers.length >= 12 || isNested) this.blocks.say({ nesting: isNested ? 'rows' : 'flat' });
    this.blocks.row(numbers, line, label);
  }

  private channels(list: unknown, beside: Json): void {
    const line = this.lineOf('channels');
    const times = timesOf(beside);
    this.blocks.say({ holds: 'channels', times });
    if (Array.isArray(list)) {
      if (this.timed(list)) return;
      if (list.length > 0 && list.every(isNumberOrNull)) this.blocks.row(list.map(numberOf), line);
      else
        list.forEach((item, index) => {
          this.channel(item, times, line, { index });
        });
    } else if (isObject(list)) {
      Object.entries(list).forEach(([name, item], index) => {
        const number = lastDigitsIn(name);
        this.channel(item, times, line, { index: number === undefined ? index : Number(number) });
      });
    }
  }

  private channel(item: unknown, times: Float64Array | undefined, line: number, label: DumpLabel): void {
    if (isObject(item)) {
      const own = timesOf(item);
      const index = [item.index, item.channel].find(isNumber);
      if (own) this.blocks.say({ times: own, channel: index ?? label.index });
      const values = valuesOf(item);
      if (values) this.blocks.row(values, line, { index: index ?? label.index ?? 0 });
    } else {
      const numbers: number[] = [];
      // Pairs of a time and a value.
      if (flatten(item, numbers) && !times) {
        this.blocks.say({ channel: label.index });
        for (let i = 0; i + 1 < numbers.length; i += 2) this.blocks.row([numbers[i], numbers[i + 1]], line);
      } else this.blocks.row(numbers, line, label);
    }
  }

  /** Line of the first place of a key, from 1. */
  private lineOf(key: string): number {
    const known = this.lines.get(key);
    if (known !== undefined) return known;
    // Looked for from the beginning, in what may be the only line.
    if (this.lines.size === MAX_KEYS) return this.line;
    const at = Math.max(this.text.indexOf(`"${key}"`), 0);
    let line = this.line;
    for (let i = 0; i < at; i++) if (this.text.charCodeAt(i) === LF) line++;
    this.lines.set(key, line);
    return line;
  }
}

/** Appends all numbers within. @returns whether they were in lists within a list */
function flatten(item: unknown, out: number[]): boolean {
  if (isNumberOrNull(item)) out.push(numberOf(item));
  else if (Array.isArray(item)) {
    for (const inside of item) flatten(inside, out);
    return item.some((inside) => Array.isArray(inside) || isObject(inside));
  } else if (isObject(item)) {
    const point = pointOf(item);
    if (point) out.push(...point);
    else
      return flatten(
        item.elements ?? item.data ?? item.matrix ?? item.position ?? Object.values(item).filter(isList),
        out,
      );
  }
  return false;
}

function hasJoints(value: Json): boolean {
  return Object.keys(value).some((key) => /^(joints|bones)$/i.test(key));
}

function pointOf({ x, y, z }: Json): number[] | undefined {
  return isNumber(x) && isNumber(y) && isNumber(z) ? [x, y, z] : undefined;
}

function labelOf({ index, name }: Json): DumpLabel | null {
  const label = { ...(isNumber(index) && { index }), ...(typeof name === 'string' && name !== '' && { name }) };
  return 'index' in label || 'name' in label ? label : null;
}

function timesOf({ times, time }: Json): Float64Array | undefined {
  const list = Array.isArray(times) ? times : Array.isArray(time) ? time : undefined;
  return list?.every(isNumberOrNull) ? Float64Array.from(list, numberOf) : undefined;
}

function valuesOf({ values, value, channels }: Json): number[] | undefined {
  const list = values ?? channels ?? (isNumber(value) ? [value] : value);
  return Array.isArray(list) && list.every(isNumberOrNull) ? list.map(numberOf) : undefined;
}

/** Whether it can be the numbers of one joint: a list of numbers, or of short lists. */
function isOne(value: unknown): boolean {
  const numbers: number[] = [];
  if (!isList(value)) return false;
  flatten(value, numbers);
  return [3, 12, 16].includes(numbers.length);
}

function isList(value: unknown): boolean {
  return Array.isArray(value) || isObject(value);
}

function isObject(value: unknown): value is Json {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

function isNumber(value: unknown): value is number {
  return typeof value === 'number';
}

function isNumbers(value: unknown): value is number[] {
  return Array.isArray(value) && value.every(isNumber);
}

/** Programs that have no JSON for NaN print null. */
function isNumberOrNull(value: unknown): value is number | null {
  return typeof value === 'number' || value === null;
}

function numberOf(value: number | null): number {
  return value ?? Number.NaN;
}
