/** Finds, inspects and runs the page's actions. */

import { type Character, findCharacter } from '../../../model/document.ts';
import { partsOf } from '../../../model/skeleton/selected-joints.ts';
import type { Action, Uses } from '../workbench.ts';

/** All current actions. */
export function actionsOf({ actions }: Uses<'actions'>): readonly Action[] {
  return actions.all();
}

export function findAction(wb: Uses<'actions'>, id: string): Action | undefined {
  return actionsOf(wb).find((action) => action.id === id);
}

export function actionLabel({ actions }: Uses<'actions'>, action: Action): string {
  return actions.label(action);
}

export function isEnabled({ actions }: Uses<'actions'>, action: Action): boolean {
  return actions.refusal(action) === undefined;
}

/** Undefined if it isn't checkable. */
export function isChecked({ actions }: Uses<'actions'>, action: Action): boolean | 'mixed' | undefined {
  return actions.checked(action);
}

/** Why it is disabled, as a sentence; undefined for one that says nothing. */
export function reasonNot({ actions }: Uses<'actions'>, action: Action): string | undefined {
  return action.quiet ? undefined : actions.refusal(action);
}

/** The default character: the selected one, else the first. */
export function currentCharacter({ store }: Uses<'store'>): Character | undefined {
  const { document, selection } = store;
  return findCharacter(document, selection.characterId) ?? document.characters[0];
}

/** The selected characters, the active one last; without any the default one. */
export function selectedCharacters(wb: Uses<'store'>): readonly Character[] {
  const { document, selection } = wb.store;
  const found = partsOf(selection).flatMap(({ characterId }) => findCharacter(document, characterId) ?? []);
  const [first] = document.characters;
  return found.length || !first ? found : [first];
}

/**
 * Runs an action by its id, as a menu would; returns a promise if its script is loaded first. Throws if there is no
 * such action, or if it is disabled.
 */
export function runAction(wb: Uses<'actions'>, id: string, args?: unknown): Promise<void> | undefined {
  const action = findAction(wb, id);
  if (!action) throw new Error(`There is no action "${id}".`);
  if (!isEnabled(wb, action)) throw new Error(`"${id}" is not available now.`);
  return wb.actions.run(action, args);
}

/** Runs it if enabled, and tells why if not, or if it changes nothing. */
export function tryAction({ actions }: Uses<'actions'>, action: Action, args?: unknown): void {
  actions.attempt(action, args);
}

/** Runs an action by its id as `tryAction` does: for what was drawn while the action was still enabled. */
export function tryById(wb: Uses<'actions'>, id: string): void {
  const action = findAction(wb, id);
  if (action) tryAction(wb, action);
}
