/**
 * The door for scripts: arguments of any kind become plain data of the command's shape or are refused, and so is a
 * result with numbers that aren't finite, such as times moved by 1e308.
 */
import type { Document } from '../../model/document.ts';
import { type Change, documentIn } from '../change.ts';
import type { AnyCommand, Command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { misfit } from './shape.ts';

/** A command that changes the document as asked by a script. */
export type ScriptedChange = Command<unknown, Document | Change>;

/** Names a character by id, name or index. @throws CommandError if there is none */
export type FindCharacter = (ref: string | number | undefined) => string;

/** Values of arguments that are left out. */
export interface Defaults {
  readonly timeSeconds: number;
  readonly playedRange: readonly [number, number];
}

/**
 * The arguments of a command, as a copy.
 * @param given `character` or `characterId` may be an id, a name, an index or an object with an id
 * @throws CommandError with the command and the argument that doesn't fit
 */
export function argumentsFrom(
  command: AnyCommand,
  given: unknown,
  defaults: Defaults,
  characterOf: FindCharacter,
): object {
  const { args: fields, notFromScripts } = command;
  if (notFromScripts) throw new CommandError(`${command.id}: Scripts can’t run this: ${notFromScripts}.`);
  try {
    const args = ownFields(given);
    const meant = refIn(args);
    args.delete('character');
    for (const [name, value] of Object.entries(defaults)) {
      if (Object.hasOwn(fields, name) && !fields[name].hasNoDefault && !args.has(name)) args.set(name, value);
    }
    if (Object.hasOwn(fields, 'characterId') && (meant !== undefined || !command.makesCharacter)) {
      args.set('characterId', characterOf(meant));
    }
    return command.read(Object.fromEntries(args));
  } catch (error) {
    // Getters and proxies may throw anything.
    const why =
      error instanceof CommandError ? error.message : 'The arguments must be plain values; reading them failed.';
    throw new CommandError(`${command.id}: ${why}`);
  }
}

function ownFields(given: unknown): Map<string, unknown> {
  if (given === undefined) return new Map();
  if (typeof given !== 'object' || given === null || Array.isArray(given)) throw misfit('', 'an object', given);
  return new Map(Object.entries(given));
}

function refIn(args: ReadonlyMap<string, unknown>): string | number | undefined {
  const given = args.get('characterId') ?? args.get('character');
  const ref = typeof given === 'object' && given !== null ? Reflect.get(given, 'id') : given;
  if (ref === undefined || typeof ref === 'string' || typeof ref === 'number') return ref;
  throw misfit('characterId', 'the id, name or index of a character', given);
}

/** The command, which refuses a result that has numbers that aren't finite. */
export function finiteOnly(command: AnyCommand): ScriptedChange {
  return {
    id: command.id,
    // Its arguments were read by its shapes (`argumentsFrom`).
    label: (document, args) => command.label(document, args as never),
    run(document, args) {
      const change = command.runRead(document, args as never);
      const found = notFinite(document, documentIn(change), '');
      if (found === undefined) return change;
      throw new CommandError(`${command.id}: the result would not be finite: ${found}. Use smaller numbers.`);
    },
  };
}

/** Limits are the only numbers that may be infinite. */
const MAY_BE_INFINITE: readonly string[] = ['min', 'max'];

/** The first number that differs and isn't finite, with its place; undefined if there is none. */
function notFinite(before: unknown, after: unknown, path: string): string | undefined {
  if (typeof after === 'number') {
    return Number.isFinite(after) || Object.is(after, before) ? undefined : `${path} is ${after}`;
  }
  if (after === before || typeof after !== 'object' || after === null) return undefined;
  if (ArrayBuffer.isView(after)) {
    const at = after instanceof Float64Array ? after.findIndex((value) => !Number.isFinite(value)) : -1;
    return at < 0 ? undefined : `${path}[${at}]`;
  }
  const was: object = typeof before === 'object' && before !== null ? before : {};
  for (const [name, value] of Object.entries(after)) {
    if (typeof value === 'number' && MAY_BE_INFINITE.includes(name) && !Number.isNaN(value)) continue;
    const place = Array.isArray(after) ? `${path}[${name}]` : path === '' ? name : `${path}.${name}`;
    const found = notFinite(Reflect.get(was, name), value, place);
    if (found !== undefined) return found;
  }
  return undefined;
}
