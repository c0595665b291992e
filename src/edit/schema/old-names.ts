/** Names of commands and arguments from before a take was called one; people’s scripts may still have them. */

/** The present id of a command or action; `id` itself unless it is an old one. */
export function presentId(id: string): string {
  if (id === 'character.showClip') return 'character.showTake';
  return id.startsWith('clip.') ? `take.${id.slice('clip.'.length)}` : id;
}

/** Gives an argument its present name, unless that is given too. Changes `args`. */
export function renameOldArguments(args: Map<string, unknown>): void {
  if (!args.has('clip') || args.has('take')) return;
  args.set('take', args.get('clip'));
  args.delete('clip');
}
