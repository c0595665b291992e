/** Takes that were opened before the skeleton that they move. */
import type { Character } from '../../model/document.ts';
import { withTakesOf } from './assemble.ts';
import { ByStem } from './grouping.ts';
import type { Opening } from './opening.ts';

/** Gives takes from before without a skeleton to the new one that they are named after, or to the only one. */
export function adoptTakes({ base, opened, characters }: Opening): void {
  const waiting = base.characters.filter(
    ({ id, skeleton, skins, takes }) => !skeleton && !opened.has(id) && skins.length === 0 && takes.length > 0,
  );
  if (waiting.length === 0) return;
  const fresh = new ByStem<Character>();
  for (const character of characters.all) {
    const file = character.parts?.skeleton?.file;
    if (file && opened.has(character.id)) fresh.add(character, file.source);
  }
  const isOnly = characters.all.filter(({ skeleton }) => skeleton).length === 1;
  const adopted = new Set<string>();
  for (const take of waiting) {
    const found = take.sources.flatMap((source) => fresh.named(source) ?? [])[0] ?? (isOnly ? fresh.only : undefined);
    const target = found && characters.current(found);
    if (!target) continue;
    characters.replace(withTakesOf(target, take));
    adopted.add(take.id);
  }
  if (adopted.size) characters.replaceAll(characters.all.filter(({ id }) => !adopted.has(id)));
}
