/**
 * Formats and parses numbers. The interface shows at most three decimals, with a true minus sign and never `-0`; a
 * number that is copied or edited has full precision, as the shortest decimal that reads back the same.
 */
import { type Units, workedOut } from './arithmetic.ts';

/** Decimals in the interface, unless a number is copied or edited. */
export const MAX_DECIMALS = 3;

/** The shortest decimal that reads back as the same double, in ASCII. Minus zero is 0. */
export function exact(value: number): string {
  return String(value === 0 ? 0 : value);
}

/** For fields, labels and messages: no trailing zeros, huge numbers as powers of ten. */
export function shown(value: number, decimals = MAX_DECIMALS): string {
  const text = aligned(value, decimals);
  return text.includes('.') && !text.includes('e') ? text.replace(/\.?0+$/, '') : text;
}

/** With trailing zeros, so that columns line up and changing numbers keep their width. */
export function aligned(value: number, decimals = MAX_DECIMALS): string {
  if (Number.isNaN(value)) return 'NaN';
  const size = Math.abs(value);
  const text = size === Infinity ? '∞' : size >= 1e9 ? size.toExponential(2) : size.toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? `−${text}` : text;
}

/** Number of decimals that fits a width in characters: fewer for larger numbers. */
export function decimalsWithin(value: number, characters: number, decimals = MAX_DECIMALS): number {
  const whole = String(Math.trunc(Math.abs(value))).length + (value < 0 ? 2 : 1);
  return Math.max(0, Math.min(decimals, characters - whole));
}

/** The size of an error or difference, 0 or more: `0.02`, or `under 0.001` for what would round to 0. */
export function errorSize(value: number): string {
  const least = 10 ** -MAX_DECIMALS;
  return value > 0 && value < least / 2 ? `under ${least}` : shown(value);
}

/** A duration for lists: `22.92 s`. */
export function duration(lengthSeconds: number): string {
  return `${shown(lengthSeconds, 2)} s`;
}

/**
 * Parses typed input: a decimal number, with a point or a comma, or an expression (`20+5`, `-3/4`, `2*(1-0.5)`), with
 * units if there are any. Undefined if invalid.
 *
 * @param from the field's value: `+=5`, `-=5`, `*=2`, `/=2`, and `*2` and `/2` alone, change it. Without it, and if it is
 *   NaN, these are invalid
 */
export function parseNumber(text: string, units: Units = NO_UNITS, from = Number.NaN): number | undefined {
  const relative = RELATIVE.exec(text);
  if (!relative) return workedOut(text, units);
  const [, sign, amount] = relative;
  const isFactor = !/[+\-−]/.test(sign);
  const by = workedOut(amount, isFactor ? NO_UNITS : units);
  if (by === undefined || Number.isNaN(from)) return undefined;
  const value = OPERATIONS[sign[0]](from, by);
  // Without the noise of binary fractions: 0.1 and 0.2 make 0.3.
  return Number.isFinite(value) ? Number(value.toPrecision(12)) : undefined;
}
const NO_UNITS: Units = {};
const RELATIVE = /^\s*([+\-−]=|[*/×÷]=?)\s*(.*)$/;
const OPERATIONS: Readonly<Record<string, (from: number, by: number) => number>> = {
  '+': (from, by) => from + by,
  '-': (from, by) => from - by,
  '−': (from, by) => from - by,
  '*': (from, by) => from * by,
  '×': (from, by) => from * by,
  '/': (from, by) => from / by,
  '÷': (from, by) => from / by,
};

/** Why a field has reverted: `Frame: “ten” is not a number.` */
export function notANumber(label: string, typed: string): string {
  const text = typed.trim();
  return `${label}: “${text.length > MAX_QUOTED ? `${text.slice(0, MAX_QUOTED)}…` : text}” is not a number.`;
}
const MAX_QUOTED = 24;

/** Created once: creating it costs more than all formatting in a frame. */
const COUNTS = new Intl.NumberFormat('en-US');

/** `1,042`. */
export function count(value: number): string {
  return COUNTS.format(value);
}

/** `31 joints`, `1 joint`, `2 vertices`. */
export function plural(value: number, one: string, many = `${one}s`): string {
  return `${count(value)} ${value === 1 ? one : many}`;
}

/** `12 bytes`, `3.4 kB`, `52 MB`. */
export function bytes(value: number): string {
  if (value < 1000) return plural(value, 'byte');
  const units = ['kB', 'MB', 'GB'];
  let size = value / 1000;
  let unit = 0;
  while (size >= 999.5 && unit < units.length - 1) {
    size /= 1000;
    unit++;
  }
  return `${size < 10 ? size.toFixed(1) : Math.round(size)} ${units[unit]}`;
}
