/** The list of the page's actions, with the page that they operate on. */
import { CommandError } from '../../../edit/command-error.ts';
import { sentenceOf } from '../../../model/failure.ts';
import type { GroupName } from '../menus.ts';
import type { IsOver } from '../messages.ts';
import type { Action, ActionList, Uses, Workbench } from '../workbench.ts';
import { watchEffect } from './effect.ts';

/** Groups whose actions edit the document or the selection; others may change only what is drawn, which isn't watched. */
const EDITING: readonly GroupName[] = ['Edit', 'Pose', 'Rig', 'Keys', 'Select'];

export class PageActions implements ActionList {
  /**
   * @param list all current ones, in the order of the menus
   * @param page asked for as late as an action needs it
   */
  constructor(
    private readonly list: () => readonly Action[],
    private readonly page: () => Workbench,
  ) {}

  all(): readonly Action[] {
    return this.list();
  }

  label({ label }: Action): string {
    return typeof label === 'string' ? label : label(this.page());
  }

  refusal(action: Action): string | undefined {
    return action.refuses?.(this.page());
  }

  checked(action: Action): boolean | 'mixed' | undefined {
    return action.checked?.(this.page());
  }

  run(action: Action, args?: unknown): Promise<void> | undefined {
    return action.run(this.page(), args) ?? undefined;
  }

  attempt(action: Action, args?: unknown): void {
    const page = this.page();
    const refusal = this.refusal(action);
    if (refusal !== undefined) {
      const isOver = () => this.refusal(action) === undefined;
      if (!action.quiet) page.messages.note(refusal, 'info', 'until a step', isOver);
      return;
    }
    const isOver = aboutNow(page);
    const failed = (error: unknown) => {
      const text = `${this.label(action)}: ${sentenceOf(error)}`;
      // A refusal is about what was tried, and not a fault that is to be read.
      if (error instanceof CommandError) page.messages.note(text, 'warning', 'until a step', isOver);
      else page.messages.note(text, 'error');
    };
    const hasEffect = watchEffect(page);
    const tell = () => {
      if (!this.isExpectedToChange(action) || hasEffect()) return;
      const text = action.unchanged ?? `${this.label(action)}: nothing to change.`;
      page.messages.note(text, 'info', 'until a step', isOver);
    };
    try {
      const running = this.run(action, args);
      if (running) running.then(tell, failed);
      else tell();
    } catch (error) {
      failed(error);
    }
  }

  private isExpectedToChange(action: Action): boolean {
    // Choosing the option that is ticked already is no surprise.
    const isChosen = action.radio && this.checked(action);
    const edits = action.unchanged !== undefined || EDITING.includes(action.group);
    return edits && !action.quiet && !isChosen;
  }
}

/** When a message about document, selection and mode as they are now is over. */
function aboutNow({ store, posing }: Uses<'store' | 'posing'>): IsOver {
  const { document, selection } = store;
  const mode = posing.mode.get();
  return () => store.document !== document || store.selection !== selection || posing.mode.get() !== mode;
}
