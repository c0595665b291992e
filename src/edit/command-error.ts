/** A command that was refused, with a sentence for the user. */
export class CommandError extends Error {
  override readonly name = 'CommandError';
}
