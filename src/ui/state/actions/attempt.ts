/** Runs a change that may be refused: refusals become messages, other errors are bugs. */
import { CommandError } from '../../../edit/command-error.ts';
import type { Messages } from '../messages.ts';

export function attempt(messages: Pick<Messages, 'note'>, change: () => void): void {
  try {
    change();
  } catch (error) {
    if (!(error instanceof CommandError)) throw error;
    messages.note(error.message, 'warning');
  }
}
