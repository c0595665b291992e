/** Names of characters and takes of several files, which may all call them the same. */

import { type Character, findCharacter } from '../../model/document.ts';
import type { SourceFile } from '../../model/files.ts';
import { tellingNames } from '../../model/names/telling-names.ts';
import { NO_MARKS } from '../../model/part.ts';
import type { Take } from '../../model/takes/take.ts';
import { renamedTake } from '../../model/takes/tracked-take.ts';
import type { Opening } from './opening.ts';

interface NewTake {
  readonly take: Take;
  readonly input: SourceFile;
  readonly isOnly: boolean;
}

/** Tells new characters, and new takes that came inside files of whole characters, from others of the same name. */
export function nameApart(opening: Opening): void {
  nameCharactersApart(opening);
  nameTakesApart(opening);
}

function nameCharactersApart({ characters, base, opened }: Opening): void {
  const fresh = characters.all.filter((c) => opened.has(c.id) && !findCharacter(base, c.id) && c.sources.length > 0);
  const names = tellingNames(
    fresh.map(({ name, sources: [input] }) => ({ name, input, isOnly: true })),
    base.characters.map(({ name }) => name),
  );
  for (const [i, character] of fresh.entries()) {
    if (names[i] !== character.name) characters.replace({ ...character, name: names[i] });
  }
}

/** Gives new takes that share a name with another file's the name of their file. */
function nameTakesApart({ characters, base, opened }: Opening): void {
  const fresh = characters.all.flatMap((c) => (opened.has(c.id) ? newTakes(c, findCharacter(base, c.id)) : []));
  if (fresh.length === 0) return;
  const isNew = new Set(fresh.map(({ take }) => take));
  const others = characters.all.flatMap(({ takes }) => takes.filter((take) => !isNew.has(take)));
  const names = tellingNames(
    fresh.map(({ take: { name }, input, isOnly }) => ({ name, input, isOnly })),
    others.map(({ name }) => name),
  );
  const renamed = new Map(fresh.flatMap(({ take }, i) => (names[i] === take.name ? [] : [[take, names[i]] as const])));
  for (const character of renamed.size > 0 ? characters.all : []) {
    if (!character.takes.some((take) => renamed.has(take))) continue;
    const takes = character.takes.map((take) => {
      const name = renamed.get(take);
      return name === undefined ? take : renamedTake(take, name);
    });
    characters.replace({ ...character, takes });
  }
}

function newTakes({ takes, parts = NO_MARKS }: Character, before: Character | undefined): readonly NewTake[] {
  const known = new Set(before?.takes.map(({ name }) => name));
  const inputs = takes.map((_, i) => {
    const file = parts.takes[i]?.file;
    return file?.kind === 'character' ? file.source : undefined;
  });
  const counts = new Map<SourceFile, number>();
  for (const input of inputs) if (input) counts.set(input, (counts.get(input) ?? 0) + 1);
  return takes.flatMap((take, i) => {
    const input = inputs[i];
    return !input || known.has(take.name) ? [] : [{ take, input, isOnly: counts.get(input) === 1 }];
  });
}
