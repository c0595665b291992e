/** Remembers characters as opened, so that K can tell what was posed since. */
import type { Character } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';

/**
 * A character with another skeleton or other morphs counts as reopened, and takes are added as opened. Runs until
 * ended.
 */
export function followOpened({ store, posing }: Uses<'store' | 'posing'>): () => void {
  const { opened } = posing;
  const look = () => {
    const { characters } = store.document;
    for (const character of characters) {
      const before = opened.get(character.id);
      if (before && before.skeleton === character.skeleton && before.morphs === character.morphs) {
        const next = withTakesFromFiles(before, character);
        if (next !== before) opened.set(character.id, next);
      } else opened.set(character.id, character);
    }
    if (opened.size === characters.length) return;
    const ids = new Set(characters.map((c) => c.id));
    for (const id of opened.keys()) if (!ids.has(id)) opened.delete(id);
  };
  look();
  return store.subscribe((now, before) => {
    if (now.document !== before.document) look();
  });
}

/** Takes that were read later; those made here begin in the pose. */
function withTakesFromFiles(opened: Character, now: Character): Character {
  if (now.takes.length <= opened.takes.length) return opened;
  const isNew = (name: string) => !opened.takes.some((take) => take.name === name);
  const read = now.takes.filter(({ name }, i) => now.parts?.takes[i]?.file && isNew(name));
  return read.length ? { ...opened, takes: [...opened.takes, ...read] } : opened;
}
