/** A change that may be refused: the refusal is a sentence for whoever asked, anything else is a fault. */
import { CommandError } from '../../edit/store.ts';
import type { Messages } from './messages.ts';

export function attempt(messages: Messages, change: () => void): void {
  try {
    change();
  } catch (error) {
    if (!(error instanceof CommandError)) throw error;
    messages.note(error.message, 'warning');
  }
}
