/** What there is to be written: files, each with the parts that it holds, where it lies, and how it is made. */
import type { Store } from '../edit/store.ts';
import type { DiskFile } from '../io/disk-files.ts';
import { partsOf } from '../model/character-parts.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import { type Character, type Document, findCharacter } from '../model/document.ts';
import { fileNameOf, type Part } from '../model/part.ts';
import { type FormatKind, KINDS } from '../project/kinds.ts';
import { distinctNames } from '../project/save/distinct-names.ts';
import { isExport, jointPose, poseToSave } from '../project/save/own-formats.ts';
import { exportCharacter, type LongFile, type SavedFile, saveCharacter, writeParts } from '../project/save/saving.ts';
import type { UnsavedPart } from '../ui/state/workbench.ts';
import type { DiskHandles } from './disk-handles.ts';
import type { Unsaved } from './unsaved.ts';

export interface JobParts {
  readonly store: Store;
  readonly unsaved: Unsaved;
  readonly handles: DiskHandles;
  /** At which keys are sampled for motion capture; absent: 30. */
  readonly framesPerSecond?: () => number;
}

/** A part with whose it is, and the pose that goes into a skeleton's file. */
interface Owned {
  readonly character: Character;
  readonly part: Part;
  readonly pose: readonly number[];
}

/** One file to be written. */
export interface Job {
  readonly name: string;
  /** What it holds: several skeletons where a `.skel` has several roots, otherwise one part; none for a `.rig`. */
  readonly holds: readonly Owned[];
  readonly target: DiskFile | undefined;
  /** @param name that it is given among those that are written with it */
  write(name: string): Omit<SavedFile, 'name'> | Omit<LongFile, 'name'> | { readonly bytes: Uint8Array<ArrayBuffer> };
}

/** The files of all that changed. */
export function changedFiles({ store, unsaved, handles }: JobParts): readonly Job[] {
  const jobs: Job[] = [];
  for (const changed of unsaved.current()) {
    const owned = find(store.document, changed);
    if (!owned || jobs.some((job) => job.holds.some((h) => h.part.id === owned.part.id))) continue;
    jobs.push(
      fileOf(store.document, handles, owned.character, owned.part, (c) => poseToSave(c, unsaved.poseInFile(c))),
    );
  }
  return jobs;
}

/** The files that a character can be saved as in one format. */
export function filesOf(
  { store, handles, framesPerSecond }: JobParts,
  character: Character,
  kind: FormatKind,
): readonly Job[] {
  if (kind === 'rig') {
    return saveCharacter(character, kind).map(copyOf);
  }
  if (isExport(character, kind)) {
    return exportCharacter(character, kind, framesPerSecond && { framesPerSecond: framesPerSecond() }).map(copyOf);
  }
  const parts = partsOf(character).filter((part) => part.kind === KINDS[kind].content);
  return parts.map((part) => fileOf(store.document, handles, character, part, jointPose));
}

/** A file by which nothing counts as saved. */
function copyOf(file: SavedFile | LongFile): Job {
  const write = (name: string) => {
    const called = (list: readonly Diagnostic[]) => list.map((d) => ({ ...d, file: name }));
    if ('text' in file) return { ...file, diagnostics: called(file.diagnostics) };
    return { ...file, diagnostics: () => called(file.diagnostics()) };
  };
  return { name: file.name, holds: [], target: undefined, write };
}

/** The file that a part is in, with whatever else has to be written for it to stay whole. */
function fileOf(
  document: Document,
  handles: DiskHandles,
  character: Character,
  part: Part,
  poseOf: (c: Character) => readonly number[],
): Job {
  const owned = partsBeside(document, character, part).map(
    (own): Owned => ({ ...own, pose: own.part.kind === 'skel' ? poseOf(own.character) : [] }),
  );
  return {
    name: fileNameOf(part),
    holds: owned,
    target: handles.ofPart(part),
    write: (called) => writeParts(called, owned),
  };
}

/**
 * What is written in place comes first: a dialog needs the key that was pressed to be fresh, and writing in place may ask
 * once itself. What has no place yet has a name of its own among all of them.
 */
export function distinctJobs(jobs: readonly Job[], targetOf: (job: Job) => DiskFile | undefined): readonly Job[] {
  const [inPlace, others] = [jobs.filter((job) => targetOf(job)?.handle), jobs.filter((job) => !targetOf(job)?.handle)];
  const namesOf = (list: readonly Job[]) => list.map(({ name }) => name);
  const names = distinctNames(namesOf(others), namesOf(inPlace));
  return [...inPlace, ...others.map((job, i) => ({ ...job, name: names[i] }))];
}

function find(document: Document, { characterId, kind, index }: UnsavedPart) {
  const character = findCharacter(document, characterId);
  const part = character && partsOf(character).filter((p) => p.kind === kind)[index];
  return character && part && { character, part };
}

/** All parts of the file that one is in, in the document's order: a `.skel` or `.bvh` of several roots has one for each. */
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
