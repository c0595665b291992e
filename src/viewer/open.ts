/** Reads files and makes characters of them, in the worker of the elements, or in their page where that has none. */
import { floorOf } from '../edit/floor.ts';
import { sharedFrameRate } from '../edit/frame-rate.ts';
import { provideLayers } from '../evaluate/layers.ts';
import { skinFacts } from '../evaluate/skin/bounds.ts';
import { openFiles } from '../files/open/open-files.ts';
import { type Character, EMPTY_DOCUMENT, shownSkin } from '../model/document.ts';
import { trackedOf } from '../model/takes/tracked-take.ts';
import { parse } from '../worker/parse.ts';
import type { OpenInput, OpenOutput } from '../worker/protocol.ts';

/** The characters of files. Whatever is wrong with them is a diagnostic. */
export async function openCharacters({ files }: OpenInput): Promise<OpenOutput> {
  provideLayers();
  const { files: read, broken, diagnostics } = await parse({ files }, () => undefined);
  const { document, diagnostics: more } = openFiles(EMPTY_DOCUMENT, read, broken);
  const characters = document.characters.map(whole);
  const framesPerSecond = sharedFrameRate(document);
  return {
    characters,
    facts: characters.flatMap(factsOf),
    diagnostics: [...diagnostics, ...more],
    floor: floorOf(characters),
    ...(framesPerSecond !== undefined && { framesPerSecond }),
  };
}

/** With the channels of all takes: messages pass on what objects hold (`tracked-take.ts`). */
function whole(character: Character): Character {
  const takes = character.takes.map((take) => (trackedOf(take) ? { ...take } : take));
  return { ...character, takes };
}

function factsOf(character: Character): OpenOutput['facts'] {
  const skin = shownSkin(character);
  return skin ? [{ skin, morphs: character.morphs, facts: skinFacts(skin, character.morphs) }] : [];
}
