/** What scripts run: commands and actions by their ids. */
import { COMMANDS_AT_HAND, FETCHED_IDS } from '../../edit/commands/at-hand.ts';
import type { Command, Edit } from '../../edit/store.ts';
import type { Document } from '../../model/document.ts';
import { runAction } from '../state/action.ts';
import { type CharacterRef, resolveCharacter } from '../state/character-ref.ts';
import type { Uses } from '../state/workbench.ts';

/**
 * Runs a command of the document, or an action of the menus; returns a promise if its script is loaded first. Throws
 * if there is none of that id, or if it refuses. `args` as in `marrow.run`.
 */
export function runById(
  wb: Uses<'store' | 'actions' | 'transport'>,
  id: string,
  args: Readonly<Record<string, unknown>>,
): Promise<void> | undefined {
  const command = COMMANDS_AT_HAND.get(id);
  if (command) apply(wb, command, args);
  else if (FETCHED_IDS.has(id)) return fetchAndRun(wb, id, args);
  else return runAction(wb, id, args);
  return undefined;
}

async function fetchAndRun(
  wb: Uses<'store' | 'transport'>,
  id: string,
  args: Readonly<Record<string, unknown>>,
): Promise<void> {
  const { COMMANDS_BY_ID } = await import('../../edit/commands/all.ts');
  const command = COMMANDS_BY_ID.get(id);
  if (!command) throw new Error(`There is no command "${id}".`);
  apply(wb, command, args);
}

function apply(
  { store, transport }: Uses<'store' | 'transport'>,
  command: Command<never, Document | Edit>,
  args: Readonly<Record<string, unknown>>,
): void {
  const named = asReference(args.characterId ?? args.character);
  const { timeSeconds, range } = transport.get();
  const given = {
    timeSeconds,
    playedRange: range,
    ...args,
    ...(named === undefined && command.makesCharacter ? {} : { characterId: resolveCharacter(store, named).id }),
  };
  // Console arguments are untyped; each command checks its own.
  store.apply(command, given as never);
}

function asReference(value: unknown): CharacterRef | undefined {
  return typeof value === 'string' || typeof value === 'number' ? value : undefined;
}
