/**
 * A character's parts as files again, each in the format of its kind.
 *
 * Its own are those that it came from, or would be opened from: a figure of motion capture is a `.bvh` a take, with
 * skeleton and motion in one; every other character has its skeleton in a `.skel` and its takes in `.anim`s. In the other
 * one's formats it can be exported (`edit/convert/character-files.ts`): a copy, by which nothing counts as saved.
 */
import { animOf, bvhOf, inPose, skelOf } from '../edit/convert/character-files.ts';
import { isBvh } from '../evaluate/bvh-figure.ts';
import { channelOf } from '../evaluate/pose.ts';
import { fitOneBvh, writeBvhPieces } from '../formats/bvh/write.ts';
import { writeFile } from '../formats/write.ts';
import type { ChannelClip } from '../model/clip.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import type { Character } from '../model/document.ts';
import { jointDofCount, rootDofCount } from '../model/dofs.ts';
import { type Figure, type FileContent, type FileKind, type SourceFile, stemOf } from '../model/files.ts';
import type { Morph } from '../model/morph.ts';
import type { Rig } from '../model/rig.ts';
import type { Skeleton } from '../model/skeleton.ts';
import type { Skin } from '../model/skin.ts';

export interface SavedFile {
  readonly name: string;
  readonly text: string;
  /** Names that had to be changed for the format. */
  readonly diagnostics: readonly Diagnostic[];
}

/** A file too long to be written in one go: its text in pieces, and what is known when all of them were taken. */
export interface LongFile {
  readonly name: string;
  readonly pieces: Iterable<string>;
  diagnostics(): readonly Diagnostic[];
}

/** A take of motion capture: its skeleton and how it moves, which one `.bvh` holds. */
export interface BvhTake extends Figure {
  /** Of the clip, or of the skeleton where there is none. */
  readonly name: string;
}

/** One of a character's parts, with the kind of file that holds it. */
export type Part =
  | { readonly kind: 'skel'; readonly part: Skeleton }
  | { readonly kind: 'skin'; readonly part: Skin }
  | { readonly kind: 'morph'; readonly part: Morph }
  | { readonly kind: 'anim'; readonly part: ChannelClip }
  | { readonly kind: 'bvh'; readonly part: BvhTake };

/** All that a character is made of, in the order in which one would open it. */
export function partsOf(character: Character): readonly Part[] {
  const { skeleton, skins, morphs, clips } = character;
  const isTake = (clip: ChannelClip) => isBvh(character) && !isFromAnim(character, clip);
  const takes = skeleton && isBvh(character) ? takesOf(skeleton, clips.filter(isTake)) : undefined;
  return [
    ...(takes ?? []).map((part) => ({ kind: 'bvh', part }) as const),
    ...(skeleton && !takes ? [{ kind: 'skel', part: skeleton } as const] : []),
    ...skins.map((part) => ({ kind: 'skin', part }) as const),
    ...morphs.map((part) => ({ kind: 'morph', part }) as const),
    ...clips.filter((clip) => !isTake(clip)).map((part) => ({ kind: 'anim', part }) as const),
  ];
}

/** Whether a clip of a figure of motion capture was read from an `.anim`, which stays its file. */
function isFromAnim({ sources }: Character, { name }: ChannelClip): boolean {
  return sources.some((source) => source.name.toLowerCase().endsWith('.anim') && stemOf(source) === name);
}

/** One for each clip; without any, the skeleton alone is one. */
function takesOf(skeleton: Skeleton, clips: readonly ChannelClip[]): readonly BvhTake[] {
  return clips.length ? clips.map((clip) => takeOf(skeleton, clip)) : [takeOf(skeleton, undefined)];
}

/** A take is the same object as long as its parts are: by identity it is told whether it changed. */
const takes = new WeakMap<Skeleton, WeakMap<object, BvhTake>>();

function takeOf(skeleton: Skeleton, clip: ChannelClip | undefined): BvhTake {
  const known = takes.get(skeleton) ?? new WeakMap<object, BvhTake>();
  takes.set(skeleton, known);
  const key = clip ?? skeleton;
  const take = known.get(key) ?? { name: clip?.name ?? skeleton.name, skeleton, ...(clip && { clip }) };
  known.set(key, take);
  return take;
}

/**
 * The file that a part came from; undefined where it came from none, or where several have its name and a guess would
 * overwrite the wrong one.
 */
export function sourceOf({ sources }: Character, { kind, part }: Part): SourceFile | undefined {
  const ending = `.${kind}`;
  // Of a `.bvh` too; its takes have the names of their skeletons then.
  const isRootOf = (s: SourceFile) =>
    kind === 'bvh' && part.name === part.skeleton.name && part.name.startsWith(stemOf(s));
  const fits = sources.filter(
    // Several roots of one `.skel` are several characters, whose skeletons have names of their own.
    (s) => s.name.toLowerCase().endsWith(ending) && (kind === 'skel' || stemOf(s) === part.name || isRootOf(s)),
  );
  return fits.length === 1 ? fits[0] : undefined;
}

/** `wasp_walk.anim`: as its file is called, or would be. */
export function fileNameOf(character: Character, part: Part): string {
  return sourceOf(character, part)?.name ?? nameOf(part);
}

export interface ExportOptions {
  /** Of `.bvh`, for clips that have no rate of their own; absent: 30. */
  readonly framesPerSecond?: number;
}

/** The files that saving a character as `kind` gives: none where it has nothing of it, several for several morphs. */
export function saveCharacter(character: Character, kind: FileKind, options: ExportOptions = {}): readonly SavedFile[] {
  if (kind === 'rig') return [write(`${character.name}.rig`, { kind, rig: rigOf(character) })];
  if (isExport(character, kind)) return exportCharacter(character, kind, options).map(asText);
  const parts = partsOf(character).filter((p) => p.kind === kind);
  return parts.map((part) => {
    return part.kind === 'bvh'
      ? asText(saveTakes(nameOf(part), [{ character, take: part.part }], options))
      : write(nameOf(part), contentOf(part, jointPose(character)));
  });
}

/** Whether that is a format of which the character has nothing itself, but which it can be converted to. */
export function isExport(character: Character, kind: FileKind): boolean {
  if (!character.skeleton) return false;
  if (kind === 'bvh') return !isBvh(character);
  return (kind === 'skel' || kind === 'anim') && isBvh(character);
}

/** Copies in a format that is not its own. */
export function exportCharacter(
  character: Character,
  kind: FileKind,
  { framesPerSecond }: ExportOptions = {},
): readonly LongFile[] {
  switch (kind) {
    case 'bvh':
      return bvhOf(character, hasOwnRate(character) ? undefined : framesPerSecond).map(
        ({ name, figure, diagnostics }) => {
          const file = `${name}.bvh`;
          const written = writeBvhPieces([figure], file);
          return { name: file, pieces: written.pieces, diagnostics: () => [...diagnostics, ...written.diagnostics()] };
        },
      );
    case 'skel': {
      const skeleton = skelOf(character);
      return skeleton ? [asLong(write(`${skeleton.name}.skel`, { kind, skeletons: [skeleton] }))] : [];
    }
    case 'anim':
      return character.clips.map((clip) => asLong(write(`${clip.name}.anim`, { kind, clip: animOf(character, clip) })));
    default:
      return [];
  }
}

/** Whether all its clips say at which times they are sampled. */
function hasOwnRate({ clips, driver }: Character): boolean {
  if (driver) return driver.source.clip.samples !== undefined;
  return clips.length > 0 && clips.every(({ samples }) => samples !== undefined);
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
    const rate = take.clip?.samples ? undefined : framesPerSecond;
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
  const text = [...pieces].join('');
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

/** The pose of the joints as set: one value for each of their DOFs, without root translation and morphs. */
export function jointPose({ pose, skeleton }: Character): readonly number[] {
  return pose.slice(rootDofCount(skeleton), rootDofCount(skeleton) + jointDofCount(skeleton));
}

/**
 * The pose that saving writes of itself: as set, but where the take shown has a channel for a DOF, what the file has
 * stays. What one sees there is the take's, and a pose that lies hidden under keys should not end up in a skeleton.
 *
 * @param inFile one value for each DOF of the joints
 */
export function poseToSave(character: Character, inFile: readonly number[]): readonly number[] {
  const first = rootDofCount(character.skeleton);
  let changed: number[] | undefined;
  for (let d = 0; d < inFile.length; d++) {
    const value = character.pose[first + d] ?? 0;
    if (value === inFile[d] || channelOf(character, first + d)) continue;
    changed ??= [...inFile];
    changed[d] = value;
  }
  return changed ?? inFile;
}

function nameOf({ kind, part }: Part): string {
  return `${part.name}.${kind}`;
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
    ...(skeleton && { skeleton: `${skeleton.name}.skel` }),
    ...(skin && { skin: `${skin.name}.skin` }),
    morphs: morphs.map((morph) => `${morph.name}.morph`),
    ...(clip && { animation: `${clip.name}.anim` }),
  };
}
