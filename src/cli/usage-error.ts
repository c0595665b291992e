import { UserError } from '../model/user-error.ts';

/** Wrong usage: exit code 2. The message is a whole sentence. */
export class UsageError extends UserError {
  override readonly name = 'UsageError';
}
