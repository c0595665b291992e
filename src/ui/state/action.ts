/** Finding, reading and running what is on the page's list of actions (`Workbench.actions`). */
import { type Character, findCharacter } from '../../model/document.ts';
import type { Action, Workbench } from './workbench.ts';

/** All of them on this page just now. */
export function actionsOf(wb: Workbench): readonly Action[] {
  return wb.actions(wb);
}

export function findAction(wb: Workbench, id: string): Action | undefined {
  return actionsOf(wb).find((action) => action.id === id);
}

export function actionLabel(wb: Workbench, action: Action): string {
  return typeof action.label === 'string' ? action.label : action.label(wb);
}

export function isEnabled(wb: Workbench, action: Action): boolean {
  return action.enabled?.(wb) ?? true;
}

/** The character that is meant where none is named: the selected one, else the first. */
export function currentCharacter(wb: Workbench): Character | undefined {
  const { document, selection } = wb.store;
  return findCharacter(document, selection.characterId) ?? document.characters[0];
}

/**
 * Runs an action by its id, as a menu would; gives a promise where its script is fetched first. Throws where there is none,
 * or where it can't run just now.
 */
export function runAction(wb: Workbench, id: string, args?: unknown): Promise<void> | undefined {
  const action = findAction(wb, id);
  if (!action) throw new Error(`There is no action "${id}".`);
  if (action.enabled && !action.enabled(wb)) throw new Error(`"${id}" can't be done just now.`);
  return action.run(wb, args) ?? undefined;
}

/** Runs it if it can run; a refusal becomes a message. */
export function tryAction(wb: Workbench, action: Action, args?: unknown): void {
  if (!isEnabled(wb, action)) return;
  const failed = (error: unknown) => {
    const why = error instanceof Error ? error.message : String(error);
    wb.messages.note(`${actionLabel(wb, action)}: ${why}`, 'error');
  };
  try {
    action.run(wb, args)?.catch(failed);
  } catch (error) {
    failed(error);
  }
}
