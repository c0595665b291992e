/**
 * Numbers as text, and back. Three manners: *exact*, the shortest decimal that reads back the same (copied, typed over);
 * *shown*, cut to what a column has room for (never wider while a character plays); and *in a field*, cut further, for a
 * field gives the exact number to who looks at it.
 */
import { type Units, workedOut } from './arithmetic.ts';

/** The shortest decimal that reads back as the same double. Minus zero is 0. */
export function exact(value: number): string {
  return String(value === 0 ? 0 : value);
}

/** At most so many decimals, without trailing zeros; huge and tiny numbers as powers of ten. */
export function shown(value: number, decimals = 4): string {
  if (!Number.isFinite(value)) return String(value);
  const size = Math.abs(value);
  if (size >= 1e7) return value.toExponential(4);
  const fixed = value.toFixed(decimals);
  // Too small for the decimals but not nothing: 1e-9 must not read as 0 where someone looks for a fault.
  if (size > 0 && Number(fixed) === 0 && size < 0.5 * 10 ** -decimals) {
    return size < 1e-12 ? '0' : value.toExponential(1);
  }
  const trimmed = fixed.includes('.') ? fixed.replace(/\.?0+$/, '') : fixed;
  return trimmed === '-0' ? '0' : trimmed;
}

/**
 * For a field, which gives the exact number to who looks at it: at most so many decimals, up to four where fewer would
 * leave nothing of a small number, and 0 for what is smaller still. What a computation leaves behind is no number to read.
 */
export function inField(value: number, decimals = 4): string {
  const places = Math.abs(value) < 10 ** -decimals ? Math.max(decimals, LEAST_IN_FIELD) : decimals;
  return shown(Math.abs(value) < 0.5 * 10 ** -places ? 0 : value, places);
}
const LEAST_IN_FIELD = 4;

/** Always so many decimals, so that columns line up; a true minus sign's width is kept by tabular figures. */
export function aligned(value: number, decimals = 4): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? 'NaN' : value > 0 ? '∞' : '−∞';
  if (Math.abs(value) >= 1e7) return value.toExponential(2);
  const fixed = value.toFixed(decimals);
  return Number(fixed) === 0 ? (0).toFixed(decimals) : fixed;
}

/** `aligned` with fewer decimals for larger numbers, so that a column of `characters` holds it. */
export function fitted(value: number, decimals: number, characters: number): string {
  const whole = Math.max(0, Math.floor(Math.log10(Math.abs(value)))) + (value < 0 ? 3 : 2);
  return aligned(value, Number.isFinite(whole) ? Math.max(1, Math.min(decimals, characters - whole)) : decimals);
}

/** `inField` with fewer decimals for larger numbers, so that a field of `characters` holds it. */
export function brief(value: number, decimals: number, characters: number): string {
  const whole = String(Math.trunc(Math.abs(value))).length + (value < 0 ? 2 : 1);
  return inField(value, Math.max(0, Math.min(decimals, characters - whole)));
}

/** Times on screen: up to 6 decimals of a second. */
export function seconds(value: number): string {
  return shown(value, 6);
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
  return `${label}: “${text.length > MOST_QUOTED ? `${text.slice(0, MOST_QUOTED)}…` : text}” is not a number.`;
}
const MOST_QUOTED = 24;

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
