/** Arguments that nobody means to give: values that are none, names from prototypes, extremes, traps. */
import fc from 'fast-check';
import type { Dice } from './dice.ts';

class OwnList extends Array<number> {
  override map(): never {
    throw new Error('A list of its own kind.');
  }
}

const cyclic: Record<string, unknown> = {};
cyclic.self = cyclic;

const trap = () => {
  throw new RangeError('A trap was read.');
};

/** One of each call: some are changed by reading. */
const ODD: readonly (() => unknown)[] = [
  ...['length', 'map', '__proto__', 'constructor', 'toString', '', ' ', '0', '1e3', '\ud800', '💀'].map((v) => () => v),
  ...[Number.NaN, Infinity, -Infinity, -0, 0, 0.5, -1, -1.5, 1, 2, 1e308, -1e308, 1.7e308, 1e-300, 5e-324].map(
    (v) => () => v,
  ),
  ...[1e9, 1e12, 1e15, 2 ** 31, 2 ** 32 - 1, 2 ** 32, 2 ** 53, 2 ** 53 + 2, 1e21].map((v) => () => v),
  ...[null, undefined, true, false, 5n, Symbol('odd'), () => 1, Math.max].map((v) => () => v),
  () => [],
  () => ({}),
  () => [[]],
  () => [Number.NaN],
  () => [1e308, -1e308],
  () => Object.assign([], { length: 2 ** 32 - 1 }),
  () => Object.assign([], { 1: 1 }),
  () => OwnList.of(0, 1),
  () => cyclic,
  () => [cyclic],
  () => ({
    get index() {
      return trap();
    },
  }),
  () => ({
    get length() {
      return 2 ** 32 - 1;
    },
  }),
  () => new Proxy({}, { get: trap, has: trap, ownKeys: trap, getOwnPropertyDescriptor: trap, getPrototypeOf: trap }),
  () => new Proxy([], { get: trap }),
  () => new Proxy([], { get: (target, name) => (name === 'length' ? 2 ** 32 - 1 : Reflect.get(target, name)) }),
  () => Object.create(null),
  () => Object.create({ index: 0, value: 1, channel: 0, indices: [0], characterId: 'c1' }),
  () => JSON.parse('{"__proto__": {"index": 0}, "constructor": 1}'),
  () => new Date(0),
  () => new Map([['index', 0]]),
  () => new Set([1]),
  () => new Error('odd'),
  () => Promise.resolve(1),
  () => new Float64Array(3),
  () => new Float64Array([Number.NaN]),
  () => new Uint8Array(2),
  () => ({ valueOf: () => 1, toString: trap }),
  () => ({ [Symbol.toPrimitive]: trap }),
  () => 'x'.repeat(1 << 21),
];

const isRecord = (value: unknown): value is object =>
  typeof value === 'object' && value !== null && !ArrayBuffer.isView(value);

/** The arguments with one odd value somewhere, or odd altogether. */
export function oddly(args: unknown, dice: Dice): unknown {
  if (!isRecord(args) || dice.is(0.15)) return dice.pick(ODD)();
  const names = Object.keys(args);
  if (dice.is(0.1) || names.length === 0) return extended(args, dice);
  const name = dice.pick(names);
  const value: unknown = dice.is(0.1) ? undefined : oddly(Reflect.get(args, name), dice);
  if (Array.isArray(args)) return args.with(Number(name), value);
  return { ...args, [name]: value };
}

function extended(args: object, dice: Dice): unknown {
  if (Array.isArray(args)) return [...args, dice.pick(ODD)()];
  const name = dice.pick(['__proto__', 'extra', 'length', 'constructor', 'timeSeconds', 'characterId', 'key', 'take']);
  return Object.fromEntries([...Object.entries(args), [name, dice.pick(ODD)()]]);
}

/** Numbers that every calculation has to bear. */
export const extreme = fc.oneof(
  fc.constantFrom(1e308, -1e308, 1e-300, -1e-300, 1e9, 1.7e15, 1.7e18, 1e16, 0, -0),
  fc.double({ noNaN: true, noDefaultInfinity: true }),
);

/** The arguments with some of their numbers made extreme. */
export function extremely(args: unknown, dice: Dice, numbers: readonly number[]): unknown {
  if (typeof args === 'number') return dice.is(0.4) ? dice.pick(numbers) : args;
  if (Array.isArray(args)) return args.map((value) => extremely(value, dice, numbers));
  if (args instanceof Float64Array) return args.map((value) => (dice.is(0.4) ? dice.pick(numbers) : value));
  if (!isRecord(args)) return args;
  return Object.fromEntries(Object.entries(args).map(([name, value]) => [name, extremely(value, dice, numbers)]));
}
