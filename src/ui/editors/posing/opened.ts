/** Remembers characters as opened, so that K can tell what was posed since. */
import type { Uses } from '../../state/workbench.ts';

/** A character with another skeleton or other morphs counts as reopened. Runs until ended. */
export function followOpened({ store, posing }: Uses<'store' | 'posing'>): () => void {
  const { opened } = posing;
  const look = () => {
    const { characters } = store.document;
    for (const character of characters) {
      const before = opened.get(character.id);
      if (before?.skeleton === character.skeleton && before?.morphs === character.morphs) continue;
      opened.set(character.id, character);
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
