/** Names of takes that came inside files of whole characters, which may all call them the same. */
import type { ChannelClip } from '../../model/clip.ts';
import { type Character, type Document, findCharacter } from '../../model/document.ts';
import type { SourceFile } from '../../model/files.ts';
import { NO_MARKS } from '../../model/part.ts';
import { tellingNames } from '../../model/telling-names.ts';
import type { OpenCharacters } from './open-characters.ts';

interface NewTake {
  readonly clip: ChannelClip;
  readonly input: SourceFile;
  readonly isOnly: boolean;
}

/**
 * Gives new takes that share a name with another file's the name of their file.
 *
 * @param before the document without what was opened
 * @param opened ids of new and changed characters
 */
export function nameTakesApart(characters: OpenCharacters, before: Document, opened: ReadonlySet<string>): void {
  const fresh = characters.all.flatMap((c) => (opened.has(c.id) ? newTakes(c, findCharacter(before, c.id)) : []));
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
