/**
 * A character's parts as files again, each in the format of its kind (`parts.ts`). In the formats that are not its own it
 * can be exported (`character-files.ts`): a copy, by which nothing counts as saved.
 *
 * A skeleton that was read from the axis-angle form is kept in that form as long as it fits into it; each form is an
 * export of the other.
 */
import { fitOneBvh, writeBvhPieces } from '../../formats/bvh/write.ts';
import { axisAngleObstacle, inAxisAngleForm, inHierarchyForm } from '../../model/axis-angle.ts';
import { partsOf } from '../../model/character-parts.ts';
import type { Diagnostic } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import type { FileContent } from '../../model/files.ts';
import { newFileName, type Part } from '../../model/part.ts';
import type { Rig } from '../../model/rig.ts';
import { type FormatKind, KINDS } from '../kinds.ts';
import { animOf, bvhOf, hasOwnRate, inPose, skelOf } from './character-files.ts';
import { isExport, jointPose, posesByNames } from './own-formats.ts';
import { writeFile } from './writers.ts';

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
  const parts = partsOf(character).filter((p) => p.kind === KINDS[kind].content);
  const pose = jointPose(character);
  return parts.map((part) =>
    inOnePiece(newFileName(part), writeParts(newFileName(part), [{ character, part, pose }], options)),
  );
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
    default: {
      const pose = jointPose(character);
      const parts = partsOf(character).filter((part) => part.kind === KINDS[kind].content);
      return parts.map((part) => {
        const name = `${part.name}.${KINDS[kind].extensions[0]}`;
        return asLong(inOnePiece(name, writeParts(name, [{ character, part, pose }])));
      });
    }
  }
}

/** Whether all its clips say at which times they are sampled. */
function haveOwnRates({ clips, driver }: Character): boolean {
  if (driver) return hasOwnRate(driver.source.clip);
  return clips.length > 0 && clips.every(hasOwnRate);
}

/** A part with whose it is, and the pose that goes into a skeleton's file: one value for each DOF of its joints. */
export interface Owned {
  readonly character: Character;
  readonly part: Part;
  readonly pose: readonly number[];
}

/**
 * Parts as one file: several skeletons or takes, each a root of its own, or a single part of another kind.
 * @throws Error, in a sentence, where roots of one `.bvh` have no longer the same frames
 */
export function writeParts(
  name: string,
  owned: readonly Owned[],
  options: ExportOptions = {},
): Omit<SavedFile, 'name'> | Omit<LongFile, 'name'> {
  const [{ part }] = owned;
  switch (part.kind) {
    case 'bvh':
      return writeTakes(name, owned, options);
    case 'skel': {
      const skeletons = owned.flatMap(({ part: own, pose }) =>
        own.kind === 'skel' ? [inPose(own.content, pose)] : [],
      );
      return write(name, { kind: 'skel', skeletons });
    }
    case 'skin':
      return write(name, { kind: 'skin', skin: part.content });
    case 'morph':
      return write(name, { kind: 'morph', morph: part.content });
    case 'anim':
      return write(name, { kind: 'anim', clip: part.content });
    case 'pose':
      return write(name, { kind: 'pose', poses: posesByNames(part.content) });
  }
}

function writeTakes(name: string, roots: readonly Owned[], { framesPerSecond }: ExportOptions): LongFile {
  const made = roots.flatMap(({ character: { driver: _, ...character }, part }) => {
    if (part.kind !== 'bvh') return [];
    // The take itself, whatever else moves the character just now.
    const { clip } = part.content;
    const rate = clip && hasOwnRate(clip) ? undefined : framesPerSecond;
    return bvhOf({ ...character, clips: clip ? [clip] : [], shownClip: clip ? 0 : -1 }, rate);
  });
  const figures = made.map(({ figure }) => figure);
  if (!fitOneBvh(figures)) {
    throw new Error(
      `The figures of ${name} now have different frames, but one .bvh file needs the same frames for all: ` +
        'trim and resample them to match, or rename the takes to save each one separately.',
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

function inOnePiece(name: string, file: Omit<SavedFile, 'name'> | Omit<LongFile, 'name'>): SavedFile {
  return 'text' in file ? { ...file, name } : asText({ ...file, name });
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

/** Takes content of a kind that has a format: all but textures. */
function write(name: string, content: FileContent): SavedFile {
  const written = writeFile(content, name);
  if (!written) throw new Error(`There is no format for ${name}.`);
  return { name, ...written };
}

function rigOf(character: Character): Rig {
  const { name, skins, shownSkin, morphs, clips, shownClip } = character;
  const skeleton = partsOf(character).find(({ kind }) => kind === 'skel');
  const skin = skins[shownSkin];
  const clip = clips[shownClip];
  return {
    name,
    ...(skeleton && { skeleton: newFileName(skeleton) }),
    ...(skin && { skin: `${skin.name}.skin` }),
    morphs: morphs.map((morph) => `${morph.name}.morph`),
    ...(clip && { animation: `${clip.name}.anim` }),
  };
}
