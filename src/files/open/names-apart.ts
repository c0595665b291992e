/** Names of characters and takes of several files, which may all call them the same. */

import { type Character, findCharacter } from '../../model/document.ts';
import type { SourceFile } from '../../model/files.ts';
import { tellingNames } from '../../model/names/telling-names.ts';
import { NO_MARKS } from '../../model/part.ts';
import type { ChannelClip } from '../../model/takes/clip.ts';
import type { Opening } from './opening.ts';

interface NewTake {
  readonly clip: ChannelClip;
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
  const isNew = new Set(fresh.map(({ clip }) => clip));
  const others = characters.all.flatMap(({ clips }) => clips.filter((clip) => !isNew.has(clip)));
  const names = tellingNames(
    fresh.map(({ clip: { name }, input, isOnly }) => ({ name, input, isOnly })),
    others.map(({ name }) => name),
  );
  const renamed = new Map(fresh.flatMap(({ clip }, i) => (names[i] === clip.name ? [] : [[clip, names[i]] as const])));
  for (const character of renamed.size > 0 ? characters.all : []) {
    if (!character.clips.some((clip) => renamed.has(clip))) continue;
    const clips = character.clips.map((clip) => {
      const name = renamed.get(clip);
      return name === undefined ? clip : { ...clip, name };
    });
    characters.replace({ ...character, clips });
  }
}

function newTakes({ clips, parts = NO_MARKS }: Character, before: Character | undefined): readonly NewTake[] {
  const known = new Set(before?.clips.map(({ name }) => name));
  const inputs = clips.map((_, i) => {
    const file = parts.clips[i]?.file;
    return file?.kind === 'character' ? file.source : undefined;
  });
  const counts = new Map<SourceFile, number>();
  for (const input of inputs) if (input) counts.set(input, (counts.get(input) ?? 0) + 1);
  return clips.flatMap((clip, i) => {
    const input = inputs[i];
    return !input || known.has(clip.name) ? [] : [{ clip, input, isOnly: counts.get(input) === 1 }];
  });
}
