/** What there is to be written when someone saves: files, each with the parts that it holds, and how it is made. */
import { partsOf } from '../../model/character-parts.ts';
import { type Character, type Document, findCharacter } from '../../model/document.ts';
import { fileNameOf, type Part } from '../../model/part.ts';
import type { FormatKind } from '../kinds.ts';
import { distinctNames } from './distinct-names.ts';
import type { Output } from './output.ts';
import { jointPose } from './own-formats.ts';
import type { UnsavedPart } from './saved-parts.ts';
import { copiesOf, isCopy, type Owned, partsOfKind, type SavingOptions, writeParts } from './saving.ts';

/** One file to be written. */
export interface Job {
  readonly name: string;
  /** What it holds: several skeletons where a `.skel` has several roots, otherwise one part; none for a copy. */
  readonly holds: readonly Owned[];
  /** @param name that it is given among those that are written with it */
  write(name: string): Omit<Output, 'name'>;
}

/** One value for each DOF of the joints: what of a character's pose goes into the file of its skeleton. */
type PoseOf = (character: Character) => readonly number[];

/** The files of all that changed. */
export function changedFiles(document: Document, unsaved: readonly UnsavedPart[], poseOf: PoseOf): readonly Job[] {
  const jobs: Job[] = [];
  for (const { characterId, kind, index } of unsaved) {
    const character = findCharacter(document, characterId);
    const part = character && partsOf(character).filter((own) => own.kind === kind)[index];
    if (!part || jobs.some((job) => job.holds.some((held) => held.part.id === part.id))) continue;
    jobs.push(fileOf(document, character, part, poseOf));
  }
  return jobs;
}

/** The files that a character can be saved as in one format. */
export function savedFilesOf(
  document: Document,
  character: Character,
  kind: FormatKind,
  options?: SavingOptions,
): readonly Job[] {
  if (isCopy(character, kind)) return copiesOf(character, kind, options).map(copyJob);
  return partsOfKind(character, kind).map((part) => fileOf(document, character, part, jointPose));
}

/** A file by which nothing counts as saved. */
function copyJob(file: Output): Job {
  const write = (name: string) => ({
    ...file,
    diagnostics: () => file.diagnostics().map((d) => ({ ...d, file: name })),
  });
  return { name: file.name, holds: [], write };
}

/** The file that a part is in, with whatever else has to be written for it to stay whole. */
function fileOf(document: Document, character: Character, part: Part, poseOf: PoseOf): Job {
  const holds = partsBeside(document, character, part).map(
    (own): Owned => ({ ...own, pose: own.part.kind === 'skel' ? poseOf(own.character) : [] }),
  );
  return { name: fileNameOf(part), holds, write: (called) => writeParts(called, holds) };
}

/**
 * What is written in place comes first: a dialog needs the key that was pressed to be fresh, and writing in place may ask
 * once itself. What has no place yet has a name of its own among all of them.
 */
export function distinctJobs<J extends Job>(jobs: readonly J[], hasPlace: (job: J) => boolean): readonly J[] {
  const [inPlace, others] = [jobs.filter(hasPlace), jobs.filter((job) => !hasPlace(job))];
  const namesOf = (list: readonly J[]) => list.map(({ name }) => name);
  const names = distinctNames(namesOf(others), namesOf(inPlace));
  return [...inPlace, ...others.map((job, i) => ({ ...job, name: names[i] }))];
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
