/** What an element is given of a document that was opened. */
import { floorOf } from '../edit/floor.ts';
import { sharedFrameRate } from '../edit/frame-rate.ts';
import { skinFacts } from '../evaluate/skin/bounds.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import { type Character, type Document, shownSkin } from '../model/document.ts';
import { trackedOf } from '../model/takes/tracked-take.ts';
import type { OpenOutput } from '../worker/protocol.ts';

export function openedOf(document: Document, diagnostics: readonly Diagnostic[]): OpenOutput {
  const characters = document.characters.map(whole);
  const framesPerSecond = sharedFrameRate(document);
  return {
    characters,
    facts: characters.flatMap(factsOf),
    diagnostics,
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
