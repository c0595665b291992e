/**
 * An error of ours: its message is a whole sentence for the user, about what was found, what was expected and what to
 * do now. All other errors are faults of the program or of the browser: `failure.ts` puts them into words.
 */
export class UserError extends Error {
  override readonly name: string = 'UserError';
}
