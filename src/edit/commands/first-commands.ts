/**
 * The commands that come with the page's menus. Those for keys, whole curves, samples, takes side by side, retargeting,
 * pins and skeletons come with their editors: with the algorithms they need they are larger than all of these
 * (`all.ts`).
 */
import type { AnyCommand } from '../command.ts';
import * as characters from './characters.ts';
import * as extrapolation from './extrapolation.ts';
import * as keying from './keying.ts';
import * as limits from './limits.ts';
import * as pose from './pose.ts';
import * as spaces from './spaces.ts';
import * as take from './take.ts';
import * as unkeyed from './unkeyed.ts';

/** By their ids. */
export const COMMANDS_AT_HAND: ReadonlyMap<string, AnyCommand> = commandsIn([
  pose,
  unkeyed,
  keying,
  take,
  spaces,
  limits,
  extrapolation,
  characters,
]);

/** How the ids of the other commands begin; ids of actions may begin so, too. */
const FETCHED: ReadonlySet<string> = new Set([
  'attach',
  'channels',
  'characters',
  'dofs',
  'hold',
  'ik',
  'keys',
  'layers',
  'limbs',
  'markers',
  'path',
  'poses',
  'retarget',
  'review',
  'rig',
  'samples',
  'sets',
  'skin',
  'takes',
]);

/** Whether that may be the id of a command in `all.ts`. */
export function mayBeFetched(id: string): boolean {
  return FETCHED.has(id.slice(0, id.indexOf('.')));
}

/** The commands that modules export, by their ids. */
export function commandsIn(modules: readonly object[]): ReadonlyMap<string, AnyCommand> {
  const exported = modules.flatMap((module): unknown[] => Object.values(module));
  return new Map(exported.filter(isCommand).map((command) => [command.id, command]));
}

function isCommand(exported: unknown): exported is AnyCommand {
  return typeof exported === 'object' && exported !== null && 'runRead' in exported;
}
