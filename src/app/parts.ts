/**
 * The parts that a character is made of, each with the kind of file that holds it and that file's name: what saving,
 * unsaved marks, reloading and autosave all go by. How they become text is the business of `saving.ts`, which is fetched
 * when something is saved.
 *
 * A character's own files are those that it came from, or would be opened from: a figure of motion capture is a `.bvh` a
 * take, with skeleton and motion in one; every other character has its skeleton in a `.skel` and its takes in `.anim`s.
 */
import { poseByNames } from '../edit/pose/by-names.ts';
import { channelOf } from '../evaluate/pose.ts';
import { savesAsAxisAngle } from '../model/axis-angle.ts';
import type { ChannelClip } from '../model/clip.ts';
import { type Character, isBvh } from '../model/document.ts';
import { jointDofCount, rootDofCount } from '../model/dofs.ts';
import { type Figure, type FileKind, type SourceFile, sameName, stemOf } from '../model/files.ts';
import type { Morph } from '../model/morph.ts';
import type { PoseByNames } from '../model/pose-by-names.ts';
import type { NamedPose } from '../model/poses.ts';
import type { Skeleton } from '../model/skeleton.ts';
import type { Skin } from '../model/skin.ts';

/** A take of motion capture: its skeleton and how it moves, which one `.bvh` holds. */
export interface BvhTake extends Figure {
  /** Of the clip, or of the skeleton where there is none. */
  readonly name: string;
}

/** A character's library of poses, which one `.pose` holds, by the names of what they are of. */
export interface PoseLibrary extends Pick<Character, 'skeleton' | 'morphs'> {
  /** The same for all: a character has one. */
  readonly name: 'poses';
  readonly poses: readonly NamedPose[];
}

/** One of a character's parts, with the kind of file that holds it. */
export type Part =
  | { readonly kind: 'skel'; readonly part: Skeleton }
  | { readonly kind: 'skin'; readonly part: Skin }
  | { readonly kind: 'morph'; readonly part: Morph }
  | { readonly kind: 'anim'; readonly part: ChannelClip }
  | { readonly kind: 'bvh'; readonly part: BvhTake }
  | { readonly kind: 'pose'; readonly part: PoseLibrary };

/** All that a character is made of, in the order in which one would open it. */
export function partsOf(character: Character): readonly Part[] {
  const { skeleton, skins, morphs, clips, poses } = character;
  const isTake = (clip: ChannelClip) => isBvh(character) && !isFromAnim(character, clip);
  const takes = skeleton && isBvh(character) ? takesOf(skeleton, clips.filter(isTake)) : undefined;
  return [
    ...(takes ?? []).map((part) => ({ kind: 'bvh', part }) as const),
    ...(skeleton && !takes ? [{ kind: 'skel', part: skeleton } as const] : []),
    ...skins.map((part) => ({ kind: 'skin', part }) as const),
    ...morphs.map((part) => ({ kind: 'morph', part }) as const),
    ...clips.filter((clip) => !isTake(clip)).map((part) => ({ kind: 'anim', part }) as const),
    ...(poses ? [{ kind: 'pose', part: libraryOf(character, poses) } as const] : []),
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

/** As with takes: the same object as long as the poses, and what they are of, are. */
const libraries = new WeakMap<readonly NamedPose[], PoseLibrary>();

function libraryOf({ skeleton, morphs }: Character, poses: readonly NamedPose[]): PoseLibrary {
  const known = libraries.get(poses);
  if (known && known.skeleton === skeleton && known.morphs === morphs) return known;
  const library: PoseLibrary = { name: 'poses', ...(skeleton && { skeleton }), morphs, poses };
  libraries.set(poses, library);
  return library;
}

/** What of a library its file holds. */
export function posesByNames(library: PoseLibrary): readonly PoseByNames[] {
  return library.poses.map((pose) => poseByNames(library, pose));
}

/**
 * The file that a part came from; undefined where it came from none, or where several have its name and a guess would
 * overwrite the wrong one.
 */
export function sourceOf({ sources }: Character, { kind, part }: Part): SourceFile | undefined {
  const endings = kind === 'skel' ? ['.skel', '.axskel'] : [`.${kind}`];
  // Of a `.bvh` too; its takes have the names of their skeletons then.
  const isRootOf = (s: SourceFile) =>
    kind === 'bvh' && part.name === part.skeleton.name && part.name.startsWith(stemOf(s));
  const fits = sources.filter(
    // Several roots of one `.skel` are several characters, whose skeletons have names of their own; poses have none.
    (s) =>
      endings.some((e) => s.name.toLowerCase().endsWith(e)) &&
      (kind === 'skel' || kind === 'pose' || stemOf(s) === part.name || isRootOf(s)),
  );
  return fits.length === 1 ? fits[0] : undefined;
}

/** `wasp_walk.anim`: as its file is called, or would be. */
export function fileNameOf(character: Character, part: Part): string {
  return sourceOf(character, part)?.name ?? nameOf(character, part);
}

/** The axis-angle form may be called either: as its file is, or by its own ending. */
export function nameOf({ name: own, sources }: Character, { kind, part }: Part): string {
  const name = `${kind === 'pose' ? own : part.name}.${kind}`;
  if (kind !== 'skel' || !savesAsAxisAngle(part)) return name;
  return sources.some((s) => sameName(s.name, name)) ? name : `${part.name}.axskel`;
}

/** What a character can be saved as: `skel` in the hierarchy form, or `axskel` in the axis-angle form. */
export type FormatKind = FileKind | 'axskel';

/** Whether that is a format of which the character has nothing itself, but which it can be converted to. */
export function isExport(character: Character, kind: FormatKind): boolean {
  const { skeleton } = character;
  if (!skeleton) return false;
  if (kind === 'bvh') return !isBvh(character);
  if (kind === 'axskel') return !savesAsAxisAngle(skeleton);
  return (kind === 'anim' && isBvh(character)) || (kind === 'skel' && (isBvh(character) || savesAsAxisAngle(skeleton)));
}

/** Which parts a format holds. */
export function partKindOf(kind: FormatKind): FileKind {
  return kind === 'axskel' ? 'skel' : kind;
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
