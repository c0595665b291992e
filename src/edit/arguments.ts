/**
 * Checks of command arguments, which may come unchecked from the console or a script. Each throws a `CommandError` that
 * says what was expected.
 */
import { cutText } from '../model/cut-text.ts';
import { CommandError } from './store.ts';

export function finiteNumber(value: unknown, what: string): number {
  if (typeof value === 'number' && Number.isFinite(value)) return value;
  throw new CommandError(`${what} must be a finite number, found ${described(value)}.`);
}

export function listOf(value: unknown, what: string): readonly unknown[] {
  if (Array.isArray(value)) return value;
  throw new CommandError(`${what} must be a list, found ${described(value)}.`);
}

export function oneOf<T>(value: unknown, allowed: readonly T[], what: string): T {
  const found = allowed.find((a) => a === value);
  if (found !== undefined) return found;
  throw new CommandError(`${what} must be one of ${allowed.map(described).join(', ')}, found ${described(value)}.`);
}

export function text(value: unknown, what: string): string {
  if (typeof value === 'string' && value.trim() !== '') return value;
  throw new CommandError(`${what} must be text, found ${described(value)}.`);
}

/** An index from `from` up to (excluding) `to`. */
export function indexIn(value: unknown, from: number, to: number, what: string): number {
  if (typeof value === 'number' && Number.isInteger(value) && value >= from && value < to) return value;
  throw new CommandError(`There is no ${what} number ${described(value)}; there are ${to}.`);
}

/** A value for a message: numbers and texts as they are, others by what they are. Reads none of its properties. */
export function described(value: unknown): string {
  if (typeof value === 'string') return JSON.stringify(cutText(value));
  if (typeof value === 'number' || typeof value === 'boolean' || value === null) return `${value}`;
  if (typeof value === 'object') return Array.isArray(value) ? 'a list' : 'an object';
  return value === undefined ? 'nothing' : `a ${typeof value}`;
}
