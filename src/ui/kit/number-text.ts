/**
 * Numbers as text, and back. The interface shows at most three decimals, with a true minus sign and never `-0`; full
 * precision is given where a number is copied or typed over, as the shortest decimal that reads back the same.
 */
import { type Units, workedOut } from './arithmetic.ts';

/** Decimals in the interface, unless a number is copied or edited. */
export const MAX_DECIMALS = 3;

/** The shortest decimal that reads back as the same double, in ASCII. Minus zero is 0. */
export function exact(value: number): string {
  return String(value === 0 ? 0 : value);
}

/** For fields, labels and messages: without trailing zeros, huge numbers as powers of ten. */
export function shown(value: number, decimals = MAX_DECIMALS): string {
  const text = aligned(value, decimals);
  return text.includes('.') && !text.includes('e') ? text.replace(/\.?0+$/, '') : text;
}

/** The same with trailing zeros, so that columns line up and a running number keeps its width. */
export function aligned(value: number, decimals = MAX_DECIMALS): string {
  if (Number.isNaN(value)) return 'NaN';
  const size = Math.abs(value);
  const text = size === Infinity ? '∞' : size >= 1e9 ? size.toExponential(2) : size.toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? `−${text}` : text;
}

/** Decimals that leave a number within so many characters: fewer for larger numbers. */
export function decimalsWithin(value: number, characters: number, decimals = MAX_DECIMALS): number {
  const whole = String(Math.trunc(Math.abs(value))).length + (value < 0 ? 2 : 1);
  return Math.max(0, Math.min(decimals, characters - whole));
}

/** How large an error or a difference is, 0 or more: `0.02`, `under 0.001` for what would read as 0 but is not. */
export function errorSize(value: number): string {
  const least = 10 ** -MAX_DECIMALS;
  return value > 0 && value < least / 2 ? `under ${least}` : shown(value);
}

/** How long something lasts, where lists say it: `22.92 s`. */
export function duration(lengthSeconds: number): string {
  return `${shown(lengthSeconds, 2)} s`;
}

/**
 * A number typed by a person: a decimal number, with a point or a comma, or something to be worked out (`20+5`, `-3/4`,
 * `2*(1-0.5)`), and with units where there are some. Undefined if it is none.
 */
export function parseNumber(text: string, units: Units = NO_UNITS): number | undefined {
  return workedOut(text, units);
}
const NO_UNITS: Units = {};

/** Why a field shows what it showed before: `Frame: “ten” is not a number.` */
export function notANumber(label: string, typed: string): string {
  const text = typed.trim();
  return `${label}: “${text.length > MAX_QUOTED ? `${text.slice(0, MAX_QUOTED)}…` : text}” is not a number.`;
}
const MAX_QUOTED = 24;

/** Made once: making one takes longer than all that it formats in a frame. */
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
