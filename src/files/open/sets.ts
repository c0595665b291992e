/** Giving a character the selection sets and locks of the file beside its skeleton. */
import { withoutPlace } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import type { SourceFile } from '../../model/files.ts';
import { NO_MARKS, readAs } from '../../model/part.ts';
import { type SetsByName, setsOfJoints } from '../../model/sets.ts';
import { withSource } from './assemble.ts';
import type { Given } from './beside.ts';

/** In place of those that it had; joints that it lacks are left out, and told. */
export function givenSets(character: Character, byName: SetsByName, source: SourceFile): Given {
  const { skeleton, parts = NO_MARKS } = character;
  if (!skeleton) return { character };
  const { sets, unknown } = setsOfJoints(byName, skeleton);
  const mark = readAs(parts.sets, { kind: 'sets', source, holds: skeleton.name });
  return {
    character: { ...withSource(character, source, character), sets, parts: { ...parts, sets: mark } },
    diagnostics: (called) =>
      unknown.map(({ path, what }) => {
        const message = `${path}: ${character.name} has not ${what}.`;
        return withoutPlace('warning', 'set-joint-unknown', message, called, 'left out');
      }),
  };
}
