/** Names of commands and arguments from before a take was called one; people’s scripts may still have them. */

/** The present id of a command or action; `id` itself unless it is an old one. */
export function presentId(id: string): string {
  if (id === 'character.showClip') return 'character.showTake';
  return id.startsWith('clip.') ? `take.${id.slice('clip.'.length)}` : id;
}

/** Gives arguments their present names, in lists of takes too, unless these are given as well. Changes `args`. */
export function renameOldArguments(args: Map<string, unknown>): void {
  for (const [name, value] of args)
    args.set(name, Array.isArray(value) ? value.map(withPresentNames) : withPresentNames(value));
  if (!args.has('clip') || args.has('take')) return;
  args.set('take', args.get('clip'));
  args.delete('clip');
}

/** Its take was its clip. */
function withPresentNames(value: unknown): unknown {
  if (typeof value !== 'object' || value === null || !('clip' in value) || 'take' in value) return value;
  const { clip, ...rest } = value;
  return { ...rest, take: clip };
}
