/**
 * A character's parts as files again, each in the format of its kind (`parts.ts`). In the formats that are not its own it
 * can be exported (`edit/convert/character-files.ts`): a copy, by which nothing counts as saved.
 *
 * A skeleton that was read from the axis-angle form is kept in that form as long as it fits into it; each form is an
 * export of the other.
 */
import { animOf, bvhOf, hasOwnRate, inPose, skelOf } from '../edit/convert/character-files.ts';
import { fitOneBvh, writeBvhPieces } from '../formats/bvh/write.ts';
import { writeFile } from '../formats/write.ts';
import { axisAngleObstacle, inAxisAngleForm, inHierarchyForm } from '../model/axis-angle.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import type { Character } from '../model/document.ts';
import type { FileContent } from '../model/files.ts';
import type { Rig } from '../model/rig.ts';
import type { Skeleton } from '../model/skeleton.ts';
import {
  type BvhTake,
  type FormatKind,
  isExport,
  jointPose,
  nameOf,
  type Part,
  partKindOf,
  partsOf,
  posesByNames,
} from './parts.ts';

export interface SavedFile {
  readonly name: string;
  readonly text: string;
  /** Names that had to be changed for the format. */
  readonly diagnostics: readonly Diagnostic[];
}

/** A file too long to be written in one go: its pieces, text or UTF-8, and what is known when all of them were taken. */
export interface LongFile {
  readonly name: string;
  readonly pieces: Iterable<FilePiece>;
  diagnostics(): readonly Diagnostic[];
}

export type FilePiece = string | Uint8Array<ArrayBuffer>;

export interface ExportOptions {
  /** Of `.bvh`, for clips that have no rate of their own; absent: 30. */
  readonly framesPerSecond?: number;
}

/** The files that saving a character as `kind` gives: none where it has nothing of it, several for several morphs. */
export function saveCharacter(
  character: Character,
  kind: FormatKind,
  options: ExportOptions = {},
): readonly SavedFile[] {
  if (kind === 'rig') return [write(`${character.name}.rig`, { kind, rig: rigOf(character) })];
  if (isExport(character, kind)) return exportCharacter(character, kind, options).map(asText);
  const parts = partsOf(character).filter((p) => p.kind === partKindOf(kind));
  return parts.map((part) => {
    const name = nameOf(character, part);
    return part.kind === 'bvh'
      ? asText(saveTakes(name, [{ character, take: part.part }], options))
      : write(name, contentOf(part, jointPose(character)));
  });
}

/** Copies in a format that is not its own. */
export function exportCharacter(
  character: Character,
  kind: FormatKind,
  { framesPerSecond }: ExportOptions = {},
): readonly LongFile[] {
  switch (kind) {
    case 'bvh':
      return bvhOf(character, haveOwnRates(character) ? undefined : framesPerSecond).map(
        ({ name, figure, diagnostics }) => {
          const file = `${name}.bvh`;
          const written = writeBvhPieces([figure], file);
          return { name: file, pieces: written.pieces, diagnostics: () => [...diagnostics, ...written.diagnostics()] };
        },
      );
    case 'skel': {
      const skeleton = skelOf(character);
      if (!skeleton) return [];
      return [asLong(write(`${skeleton.name}.skel`, { kind, skeletons: [inHierarchyForm(skeleton)] }))];
    }
    case 'axskel': {
      const skeleton = skelOf(character);
      if (!skeleton || axisAngleObstacle(skeleton) !== undefined) return [];
      const content = { kind: 'skel', skeletons: [inAxisAngleForm(skeleton)] } as const;
      return [asLong(write(`${skeleton.name}.axskel`, content))];
    }
    case 'anim':
      return character.clips.map((clip) => asLong(write(`${clip.name}.anim`, { kind, clip: animOf(character, clip) })));
    default:
      return [];
  }
}

/** Whether all its clips say at which times they are sampled. */
function haveOwnRates({ clips, driver }: Character): boolean {
  if (driver) return hasOwnRate(driver.source.clip);
  return clips.length > 0 && clips.every(hasOwnRate);
}

/**
 * Takes as one `.bvh`, each a root of its own.
 * @throws Error, in a sentence, where roots of one file have no longer the same frames
 */
export function saveTakes(
  name: string,
  roots: readonly { readonly character: Character; readonly take: BvhTake }[],
  { framesPerSecond }: ExportOptions = {},
): LongFile {
  const made = roots.map(({ character: { driver: _, ...character }, take }) => {
    // The take itself, whatever else moves the character just now.
    const rate = take.clip && hasOwnRate(take.clip) ? undefined : framesPerSecond;
    const [figure] = bvhOf({ ...character, clips: take.clip ? [take.clip] : [], shownClip: take.clip ? 0 : -1 }, rate);
    return figure;
  });
  const figures = made.map(({ figure }) => figure);
  if (!fitOneBvh(figures)) {
    throw new Error(
      `The figures of ${name} have different frames now, and one .bvh gives all of them the same: ` +
        'trim and resample them alike, or rename the takes to save each by itself.',
    );
  }
  const written = writeBvhPieces(figures, name);
  return {
    name,
    pieces: written.pieces,
    diagnostics: () => [
      ...made.flatMap(({ diagnostics }) => diagnostics.map((d) => ({ ...d, file: name }))),
      ...written.diagnostics(),
    ],
  };
}

function asText({ name, pieces, diagnostics }: LongFile): SavedFile {
  const decoder = new TextDecoder();
  let text = '';
  for (const piece of pieces) text += typeof piece === 'string' ? piece : decoder.decode(piece, { stream: true });
  return { name, text, diagnostics: diagnostics() };
}

function asLong({ name, text, diagnostics }: SavedFile): LongFile {
  return { name, pieces: [text], diagnostics: () => diagnostics };
}

/** One part as the text of its file; a skeleton in the pose given, one value for each DOF of its joints. */
export function savePart(part: Exclude<Part, { kind: 'bvh' }>, name: string, pose: readonly number[]): SavedFile {
  return write(name, contentOf(part, pose));
}

/** Several skeletons as one file, each a root of its own. */
export function saveSkeletons(
  name: string,
  roots: readonly { readonly skeleton: Skeleton; readonly pose: readonly number[] }[],
): SavedFile {
  return write(name, { kind: 'skel', skeletons: roots.map(({ skeleton, pose }) => inPose(skeleton, pose)) });
}

function contentOf({ kind, part }: Exclude<Part, { kind: 'bvh' }>, pose: readonly number[]): FileContent {
  switch (kind) {
    case 'skel':
      return { kind, skeletons: [inPose(part, pose)] };
    case 'skin':
      return { kind, skin: part };
    case 'morph':
      return { kind, morph: part };
    case 'anim':
      return { kind, clip: part };
    case 'pose':
      return { kind, poses: posesByNames(part) };
  }
}

/** Takes content of a kind that has a format: all but textures. */
function write(name: string, content: FileContent): SavedFile {
  const written = writeFile(content, name);
  if (!written) throw new Error(`There is no format for ${name}.`);
  return { name, ...written };
}

function rigOf(character: Character): Rig {
  const { name, skeleton, skins, shownSkin, morphs, clips, shownClip } = character;
  const skin = skins[shownSkin];
  const clip = clips[shownClip];
  return {
    name,
    ...(skeleton && { skeleton: nameOf(character, { kind: 'skel', part: skeleton }) }),
    ...(skin && { skin: `${skin.name}.skin` }),
    morphs: morphs.map((morph) => `${morph.name}.morph`),
    ...(clip && { animation: `${clip.name}.anim` }),
  };
}
