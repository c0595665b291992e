/** Files to write when the user saves: files, each with the parts that it holds and how it is written. */
import { partsOf } from '../../model/character-parts.ts';
import { type Character, type Document, findCharacter } from '../../model/document.ts';
import { sameName } from '../../model/files.ts';
import { fileNameOf, type Part, takeOf } from '../../model/part.ts';
import type { Marker } from '../../model/takes/markers.ts';
import { hasControls } from '../../model/takes/take.ts';
import type { SavedKind } from '../kinds.ts';
import { markersCopies } from './copies.ts';
import { distinctNames } from './distinct-names.ts';
import { besidePlain } from './layers.ts';
import { type Output, outputOf, savedFileOf } from './output.ts';
import type { Owned, PoseOf } from './owned.ts';
import type { UnsavedPart } from './saved-parts.ts';
import { jointPose } from './saved-poses.ts';
import { copiesOf, isCopy, partsOfKind, type SavingOptions, writeParts } from './saving.ts';

/** A file to write. */
export interface Job {
  readonly name: string;
  /** The parts in it: several skeletons for a `.skel` with several roots, otherwise one part; none for a copy. */
  readonly holds: readonly Owned[];
  /** It is beside the file of what it holds, and not that file. */
  readonly isBeside?: true;
  /** It is written together with others, and is no part itself: where it was read from, if it was. */
  readonly withOthers?: { readonly path?: string };
  /** @param name distinct among the files written together */
  write(name: string): Omit<Output, 'name'>;
}

/** The files of all changed parts. */
export function changedFiles(document: Document, unsaved: readonly UnsavedPart[], poseOf: PoseOf): readonly Job[] {
  const jobs: Job[] = [];
  for (const { characterId, kind, index, isMarkers } of unsaved) {
    const character = findCharacter(document, characterId);
    const part = character && partsOf(character).filter((own) => own.kind === kind)[index];
    if (!part || jobs.some((job) => job.holds.some((held) => held.part.id === part.id))) continue;
    if (!isMarkers) {
      const own = fileOf(document, character, part, poseOf);
      jobs.push(...withLayers(character, part, own), ...markersBeside(part));
    }
    // Deleted ones are gone from their file too.
    else
      for (const job of markersBeside(part, []))
        jobs.push({ ...job, holds: [{ character, part, pose: [] }], isBeside: true });
  }
  return jobs;
}

/**
 * The files of a take with layers, goals or attachments around its own, the JSON files last. All are made before the
 * first is written: if one can't be, none is.
 */
function withLayers(character: Character, part: Part, own: Job): readonly Job[] {
  const take = takeOf(part);
  if (!take || !hasControls(take)) return [own];
  const copies = besidePlain(character, take);
  let made: ReadonlyMap<string, Output> | undefined;
  const make = () => {
    const texts = copies.map((copy): Output => {
      const { name, text, diagnostics } = savedFileOf(outputOf(copy));
      return { name, pieces: () => [text], diagnostics: () => diagnostics };
    });
    savedFileOf({ ...own.write(own.name), name: own.name });
    return new Map(texts.map((file) => [file.name, file]));
  };
  const beside = copies.map(({ name }): Job => {
    const source = character.sources.find((file) => sameName(file.name, name));
    return {
      name,
      holds: [],
      withOthers: source ? { path: source.path } : {},
      write(called) {
        made ??= make();
        const file = made.get(name);
        if (!file) throw new Error(`Expected ${called} among the files of ${part.name}.`);
        return file;
      },
    };
  });
  const plain: Job = {
    ...own,
    write(called) {
      made ??= make();
      return own.write(called);
    },
  };
  const jsons = [take.layers, take.goals, take.attached].filter(Boolean).length;
  return [...beside.slice(0, -jsons), plain, ...beside.slice(-jsons)];
}

/** The markers of a take, beside its file. @param none what it has without markers; absent: no file */
function markersBeside(part: Part, none?: readonly Marker[]): readonly Job[] {
  const take = takeOf(part);
  if (!take) return [];
  const markers = take.markers ?? none;
  const named = { ...take, name: part.name, ...(markers && { markers }) };
  return markersCopies({ takes: [named] }).map((copy) => copyJob(outputOf(copy)));
}

/** The files of a character in one format. */
export function savedFilesOf(
  document: Document,
  character: Character,
  kind: SavedKind,
  options?: SavingOptions,
): readonly Job[] {
  if (isCopy(character, kind)) return copiesOf(character, kind, options).map(copyJob);
  return partsOfKind(character, kind).map((part) => fileOf(document, character, part, jointPose));
}

/** A copy: writing it marks nothing as saved. */
function copyJob(file: Output): Job {
  const write = (name: string) => ({
    ...file,
    diagnostics: () => file.diagnostics().map((d) => ({ ...d, file: name })),
  });
  return { name: file.name, holds: [], write };
}

/** The file of a part, with all other parts in the same file. */
function fileOf(document: Document, character: Character, part: Part, poseOf: PoseOf): Job {
  const holds = partsBeside(document, character, part).map(
    (own): Owned => ({ ...own, pose: own.part.kind === 'skel' ? poseOf(own.character) : [] }),
  );
  return { name: fileNameOf(part), holds, write: (called) => writeParts(called, holds) };
}

/**
 * Sorts files that are written in place first: a file dialog needs recent user activation, and writing in place may
 * show a permission prompt itself. Files without a place yet get distinct names.
 */
export function distinctJobs<J extends Job>(jobs: readonly J[], hasPlace: (job: J) => boolean): readonly J[] {
  const [inPlace, others] = [jobs.filter(hasPlace), jobs.filter((job) => !hasPlace(job))];
  const namesOf = (list: readonly J[]) => list.map(({ name }) => name);
  const names = distinctNames(namesOf(others), namesOf(inPlace));
  return [...inPlace, ...others.map((job, i) => ({ ...job, name: names[i] }))];
}

/** All parts in the same file, in document order: a `.skel` or `.bvh` with several roots has one for each. */
function partsBeside(document: Document, character: Character, part: Part) {
  return document.characters.flatMap((other) =>
    partsOf(other)
      .filter(
        (own) =>
          own.kind === part.kind &&
          (other === character ? own.id === part.id : own.file !== undefined && own.file.path === part.file?.path),
      )
      .map((own) => ({ character: other, part: own })),
  );
}
