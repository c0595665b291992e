/**
 * An error of ours: its message is a whole sentence for the user, about what was found, what was expected and what to
 * do now. Anything else that is thrown is a fault of the program or of the browser (`failure.ts`).
 */
export class UserError extends Error {
  override readonly name: string = 'UserError';
}
