/** What scripts run: commands and actions by their ids. */

import type { AnyCommand } from '../../edit/command.ts';
import type { CommandInfo } from '../../edit/commands/all.ts';
import { COMMANDS_AT_HAND, mayBeFetched } from '../../edit/commands/first-commands.ts';
import { argumentsFrom, finiteOnly } from '../../edit/schema/door.ts';
import { presentId } from '../../edit/schema/old-names.ts';
import { runAction } from '../state/actions/action.ts';
import { resolveCharacter } from '../state/joints/character-ref.ts';
import type { Uses } from '../state/workbench.ts';

/**
 * Runs a command of the document, or an action of the menus; returns a promise if its script is loaded first. Throws
 * if there is none of that id, or if it refuses. `args` as in `marrow.run`, of any type: they come from a console.
 */
export function runById(
  wb: Uses<'store' | 'actions' | 'transport' | 'posing'>,
  calledId: string,
  args: unknown,
): Promise<void> | undefined {
  const id = presentId(calledId);
  const command = COMMANDS_AT_HAND.get(id);
  const mirrored = id === 'pose.setDofs' ? wb.posing.mirrored.get() : undefined;
  if (command) apply(wb, mirrored ? { ...command, runRead: mirrored.run } : command, args);
  else if (mayBeFetched(id)) return fetchAndRun(wb, id, args);
  else return runAction(wb, id, args);
  return undefined;
}

async function fetchAndRun(wb: Uses<'store' | 'actions' | 'transport'>, id: string, args: unknown): Promise<void> {
  const { ALL_COMMANDS } = await import('../../edit/commands/all.ts');
  const command = ALL_COMMANDS.get(id);
  if (command) apply(wb, command, args);
  else await runAction(wb, id, args);
}

function apply({ store, transport }: Uses<'store' | 'transport'>, command: AnyCommand, args: unknown): void {
  const { timeSeconds, range } = transport.get();
  const defaults = { timeSeconds, playedRange: range };
  const given = argumentsFrom(command, args, defaults, (ref) => resolveCharacter(store, ref).id);
  store.apply(finiteOnly(command), given);
}

/** What each command takes, in words. */
export async function commands(): Promise<readonly CommandInfo[]> {
  const { commandList } = await import('../../edit/commands/all.ts');
  return commandList();
}
