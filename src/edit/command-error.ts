import { UserError } from '../model/user-error.ts';

/** A command that was refused, with a sentence for the user. */
export class CommandError extends UserError {
  override readonly name = 'CommandError';
}
