/** Checks of command arguments that shapes can't make: those that depend on the document. */
import { cutText } from '../model/names/cut-text.ts';
import { CommandError } from './command-error.ts';

/**
 * An index from `from` up to (excluding) `to`.
 * @throws CommandError for anything else, naming `what`
 */
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
