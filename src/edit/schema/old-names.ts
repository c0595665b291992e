/** Names of commands and arguments from before a take was called one; people’s scripts may still have them. */

/** The present id of a command or action; `id` itself unless it is an old one. */
export function presentId(id: string): string {
  if (id === 'character.showClip') return 'character.showTake';
  return id.startsWith('clip.') ? `take.${id.slice('clip.'.length)}` : id;
}

/** The name by which an object has a field: `name`, or its old one if only that is there. */
export function givenName(value: object, name: string): string {
  return name === 'take' && !Object.hasOwn(value, name) && Object.hasOwn(value, 'clip') ? 'clip' : name;
}
