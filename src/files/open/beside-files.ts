/**
 * JSON beside a plain file (`Kind.beside`), opened after all characters and parts, which it is found for by its name.
 * Fetched by the page when such a file is opened. A new kind takes:
 *
 * 1. `formats/NAME/read.ts` on `jsonReader`, and `write.ts` on `writeJson` (`formats/json/`): they give fields their
 * paths in messages, and tell, keep and write those that are not known. It names joints as `joint-reference.ts` does;
 * 2. its record in `KINDS` with `beside`, its `Opening` as `beside`, its entry in `GIVE` below, and what the recipe of
 * a format says; 3. if it is a part of the character, with a revision and a file of its own, a field of the character,
 * a mark in `PartMarks`, and its line in `partsOf` after all plain files: what is unsaved, saving in place after them,
 * zips, reload and autosave follow from there (`sets`). Otherwise it is a part of its take, as markers are.
 */

import { provideLayers } from '../../evaluate/layers.ts';
import { type Diagnostic, hasErrors, withoutPlace } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import {
  type ContentOf,
  type FileKind,
  folderOf,
  type ParsedFile,
  type SourceFile,
  sameName,
  stemOf,
} from '../../model/files.ts';
import { limbsOfJoints } from '../../model/limb-problems.ts';
import { NO_MARKS, readAs } from '../../model/part.ts';
import { setsOfJoints } from '../../model/sets-by-name.ts';
import { layerCode } from '../../model/takes/layer-code.ts';
import type { LimbsFile } from '../../model/takes/limbs-file.ts';
import type { Goals } from '../../model/takes/take.ts';
import { withMarkers } from '../../model/takes/with-markers.ts';
import { type Beside, besideOf, formatKindOf, KINDS, nameBeside } from '../kinds.ts';
import { withSource } from './assemble.ts';
import { openAttached } from './attach.ts';
import { prefixFit } from './grouping.ts';
import type { Opening } from './opening.ts';

/** A character with what it was given, and what is said about that. */
interface Given {
  readonly character: Character;
  readonly diagnostics?: readonly Diagnostic[];
}

/**
 * Gives a character the content of a file.
 *
 * @param called how messages name the file
 */
type Give<K extends FileKind> = (at: BesidePlace, content: ContentOf<K>, source: SourceFile, called: string) => Given;

const GIVE: { readonly [K in 'markers' | 'sets' | 'limbs']: Give<K> } = {
  markers: ({ character, take }, { markers }) => ({
    character: { ...character, takes: character.takes.with(take, withMarkers(character.takes[take], markers)) },
  }),
  // In place of those that it had; joints that it lacks are left out, and told.
  sets({ character }, { sets: byName }, source, called) {
    const { skeleton, parts = NO_MARKS } = character;
    if (!skeleton) return { character };
    const { sets, unknown } = setsOfJoints(byName, skeleton);
    const mark = readAs(parts.sets, { kind: 'sets', source, holds: skeleton.name });
    return {
      character: { ...withSource(character, source, character), sets, parts: { ...parts, sets: mark } },
      diagnostics: unknown.map(({ path, what }) => {
        const message = `${path}: ${character.name} has not ${what}.`;
        return withoutPlace('warning', 'set-joint-unknown', message, called, 'left out');
      }),
    };
  },
  // Limbs to the skeleton, in place of those that it had; goals to the take, if it is beside one.
  limbs({ character, take }, { limbs: file }, source, called) {
    const { skeleton } = character;
    if (!skeleton) return { character };
    const given = file.limbs ? withLimbs(character, file, source, called) : { character };
    if (!file.goals || take < 0) return given;
    const { goals: list, base, flattened, others } = file;
    const goals: Goals = {
      list,
      ...(base !== undefined && { baseFile: base }),
      ...(flattened?.others && { ofFlattened: flattened.others }),
      ...(others && !file.limbs && { others }),
    };
    const { takes, limbs = { list: [] } } = given.character;
    const problems = layerCode(takes[take]).goalProblems(goals, limbs, skeleton);
    const told = problems.map(({ code, goal, path, message }) => {
      const text = `goals[${goal}].${path}: ${message}`;
      return code === 'limb-cycle'
        ? withoutPlace('error', code, text, called)
        : withoutPlace('warning', code, text, called, 'left out');
    });
    const diagnostics = [...(given.diagnostics ?? []), ...told];
    if (hasErrors(told)) return { character, diagnostics };
    const withGoals = { ...given.character, takes: takes.with(take, { ...takes[take], goals }) };
    return { character: withSource(withGoals, source, character), diagnostics };
  },
};

function withLimbs(
  character: Character,
  { limbs: byName = [], others }: LimbsFile,
  source: SourceFile,
  called: string,
): Given {
  const { skeleton, parts = NO_MARKS } = character;
  if (!skeleton) return { character };
  // Who has limbs may be asked for them, and be given goals.
  provideLayers();
  const { limbs: list, problems } = limbsOfJoints(byName, skeleton);
  const mark = readAs(parts.limbs, { kind: 'limbs', source, holds: skeleton.name });
  const limbs = { list, ...(others && { others }) };
  return {
    character: { ...withSource(character, source, character), limbs, parts: { ...parts, limbs: mark } },
    diagnostics: problems.map(({ code, message }) => withoutPlace('warning', code, message, called, 'left out')),
  };
}

/** Gives JSON to the skeleton or the take that it is beside: one from the same folder, just opened, or any. */
export function openBeside(opening: Opening, file: ParsedFile): void {
  const format = formatKindOf(file.source.name);
  const beside = format && besideOf(format);
  if (!beside || opening.used.has(file)) return;
  if (file.kind === 'attach') {
    // Everything else moves leaders, or is a part of the take.
    for (const other of opening.files) if (other.kind !== 'attach') openBeside(opening, other);
  }
  if (file.kind !== 'markers' && file.kind !== 'sets' && file.kind !== 'limbs' && file.kind !== 'attach') return;
  const hasGoals = file.kind === 'limbs' && file.limbs.goals !== undefined;
  const of = hasGoals ? 'take' : beside;
  if (hasGoals) {
    // Goals are checked against the limbs.
    for (const other of opening.files) {
      if (other.kind === 'limbs' && !other.limbs.goals) openBeside(opening, other);
    }
  }
  const characters = opening.characters.all;
  const known = opening.characters.withFile(file.source);
  const fresh = characters.filter((c) => opening.opened.has(c.id));
  const place = besidePlace(of, file.source, [...known, ...fresh, ...characters]);
  if (!place) {
    opening.unused.push({ file, why: `No open ${of} has the name of this ${KINDS[format].label} file.` });
    return;
  }
  if (file.kind === 'attach') {
    openAttached(opening, file, place.character, place.take);
    return;
  }
  const called = opening.called(file.source);
  const { character, diagnostics = [] } = givenTo(place, file, called);
  opening.diagnostics.push(...diagnostics);
  if (character === place.character) return;
  opening.characters.replace(character);
  opening.opened.add(character.id);
  opening.used.add(file);
}

function givenTo(place: BesidePlace, file: ContentOf<keyof typeof GIVE> & ParsedFile, called: string): Given {
  if (file.kind === 'sets') return GIVE.sets(place, file, file.source, called);
  return file.kind === 'limbs'
    ? GIVE.limbs(place, file, file.source, called)
    : GIVE.markers(place, file, file.source, called);
}

/** The place that a file is beside: a character, and the index of its take, or -1 for its skeleton. */
interface BesidePlace {
  readonly character: Character;
  readonly take: number;
}

/**
 * `walk.markers.json` → the take `walk`; `wasp_2.sets.json` → the skeleton with the longest name that begins so, or
 * else the only one. Characters with a file from the same folder come first.
 */
function besidePlace(of: Beside, source: SourceFile, characters: readonly Character[]): BesidePlace | undefined {
  const name = nameBeside(source.name);
  const folder = folderOf(source);
  const near = characters.filter((c) => c.sources.some((own) => folderOf(own) === folder));
  if (of === 'skeleton') return skeletonBefore(name, near) ?? skeletonBefore(name, characters) ?? onlyOf(characters);
  for (const character of [...near, ...characters]) {
    const take = character.takes.findIndex((own) => sameName(own.name, name));
    if (take >= 0) return { character, take };
  }
  return undefined;
}

function skeletonBefore(name: string, characters: readonly Character[]): BesidePlace | undefined {
  let best: BesidePlace | undefined;
  let length = 0;
  for (const character of characters) {
    const { skeleton, parts } = character;
    if (!skeleton) continue;
    const file = parts?.skeleton?.file ?? parts?.takes[0]?.file;
    const fit = Math.max(prefixFit(skeleton.name, name), file ? prefixFit(stemOf(file.source), name) : 0);
    if (fit <= length) continue;
    best = { character, take: -1 };
    length = fit;
  }
  return best;
}

function onlyOf(characters: readonly Character[]): BesidePlace | undefined {
  const own = [...new Set(characters.filter(({ skeleton }) => skeleton))];
  return own.length === 1 ? { character: own[0], take: -1 } : undefined;
}
