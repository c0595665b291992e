/** Finds, inspects and runs the page's actions (`Workbench.actions`). */

import { CommandError } from '../../../edit/command-error.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import { sentenceOf } from '../../../model/failure.ts';
import type { GroupName } from '../menus.ts';
import type { IsOver } from '../messages.ts';
import type { Action, Uses } from '../workbench.ts';
import { watchEffect } from './effect.ts';

type ActionsOnPage = Uses<'actions'>;

/** All current actions. */
export function actionsOf({ actions }: ActionsOnPage): readonly Action[] {
  return actions.all();
}

export function findAction(wb: ActionsOnPage, id: string): Action | undefined {
  return actionsOf(wb).find((action) => action.id === id);
}

export function actionLabel({ actions }: ActionsOnPage, { label }: Action): string {
  return typeof label === 'string' ? label : label(actions.page);
}

export function isEnabled({ actions }: ActionsOnPage, action: Action): boolean {
  return action.refuses?.(actions.page) === undefined;
}

/** Undefined if it isn't checkable. */
export function isChecked({ actions }: ActionsOnPage, action: Action): boolean | 'mixed' | undefined {
  return action.checked?.(actions.page);
}

/** Why it is disabled, as a sentence; undefined for one that says nothing. */
export function reasonNot({ actions }: ActionsOnPage, action: Action): string | undefined {
  return action.quiet ? undefined : action.refuses?.(actions.page);
}

/** The default character: the selected one, else the first. */
export function currentCharacter({ store }: Uses<'store'>): Character | undefined {
  const { document, selection } = store;
  return findCharacter(document, selection.characterId) ?? document.characters[0];
}

/**
 * Runs an action by its id, as a menu would; returns a promise if its script is loaded first. Throws if there is no
 * such action, or if it is disabled.
 */
export function runAction(wb: ActionsOnPage, id: string, args?: unknown): Promise<void> | undefined {
  const action = findAction(wb, id);
  if (!action) throw new Error(`There is no action "${id}".`);
  if (!isEnabled(wb, action)) throw new Error(`"${id}" is not available now.`);
  return action.run(wb.actions.page, args) ?? undefined;
}

/** Runs it if enabled. A refusal becomes a message, and so does the reason if it is disabled or changes nothing. */
export function tryAction(wb: ActionsOnPage, action: Action, args?: unknown): void {
  const { page } = wb.actions;
  if (!isEnabled(wb, action)) {
    const why = reasonNot(wb, action);
    if (why) page.messages.note(why, 'info', 'until a step', () => isEnabled(wb, action));
    return;
  }
  const isOver = aboutNow(page);
  const failed = (error: unknown) => {
    const why = sentenceOf(error);
    const text = `${actionLabel(wb, action)}: ${why}`;
    // A refusal is about what was tried, and not a fault that is to be read.
    if (error instanceof CommandError) page.messages.note(text, 'warning', 'until a step', isOver);
    else page.messages.note(text, 'error');
  };
  const hasEffect = watchEffect(page);
  const tell = () => {
    if (isExpectedToChange(wb, action) && !hasEffect()) {
      page.messages.note(
        action.unchanged ?? `${actionLabel(wb, action)}: nothing to change.`,
        'info',
        'until a step',
        isOver,
      );
    }
  };
  try {
    const running = action.run(page, args);
    if (running) running.then(tell, failed);
    else tell();
  } catch (error) {
    failed(error);
  }
}

/** When a message about document, selection and mode as they are now is over. */
function aboutNow({ store, posing }: Uses<'store' | 'posing'>): IsOver {
  const { document, selection } = store;
  const mode = posing.mode.get();
  return () => store.document !== document || store.selection !== selection || posing.mode.get() !== mode;
}

/** Runs an action by its id as `tryAction` does: for what was drawn while the action was still enabled. */
export function tryById(wb: ActionsOnPage, id: string): void {
  const action = findAction(wb, id);
  if (action) tryAction(wb, action);
}

/** Groups whose actions edit the document or the selection; others may change only what is drawn, which isn't watched. */
const EDITING: readonly GroupName[] = ['Edit', 'Pose', 'Rig', 'Keys', 'Select'];

function isExpectedToChange(wb: ActionsOnPage, action: Action): boolean {
  // Choosing the option that is ticked already is no surprise.
  const isChosen = action.radio && isChecked(wb, action);
  const edits = action.unchanged !== undefined || EDITING.includes(action.group);
  return edits && !action.quiet && !isChosen;
}
