/** A character's parts as files again, each in the format of its kind. */
import { channelOf } from '../evaluate/pose.ts';
import { writeFile } from '../formats/write.ts';
import type { ChannelClip } from '../model/clip.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import type { Character } from '../model/document.ts';
import { firstDofs, jointDofCount, rootDofCount } from '../model/dofs.ts';
import { type FileContent, type FileKind, type SourceFile, stemOf } from '../model/files.ts';
import type { Morph } from '../model/morph.ts';
import type { Rig } from '../model/rig.ts';
import { dofsOf, type Skeleton } from '../model/skeleton.ts';
import type { Skin } from '../model/skin.ts';

export interface SavedFile {
  readonly name: string;
  readonly text: string;
  /** Names that had to be changed for the format. */
  readonly diagnostics: readonly Diagnostic[];
}

/** One of a character's parts, with the kind of file that holds it. */
export type Part =
  | { readonly kind: 'skel'; readonly part: Skeleton }
  | { readonly kind: 'skin'; readonly part: Skin }
  | { readonly kind: 'morph'; readonly part: Morph }
  | { readonly kind: 'anim'; readonly part: ChannelClip };

/** All that a character is made of, in the order in which one would open it. */
export function partsOf({ skeleton, skins, morphs, clips }: Character): readonly Part[] {
  return [
    ...(skeleton ? [{ kind: 'skel', part: skeleton } as const] : []),
    ...skins.map((part) => ({ kind: 'skin', part }) as const),
    ...morphs.map((part) => ({ kind: 'morph', part }) as const),
    ...clips.map((part) => ({ kind: 'anim', part }) as const),
  ];
}

/**
 * The file that a part came from; undefined where it came from none, or where several have its name and a guess would
 * overwrite the wrong one.
 */
export function sourceOf({ sources }: Character, { kind, part }: Part): SourceFile | undefined {
  const ending = `.${kind}`;
  const fits = sources.filter(
    // Several roots of one `.skel` are several characters, whose skeletons have names of their own.
    (s) => s.name.toLowerCase().endsWith(ending) && (kind === 'skel' || stemOf(s) === part.name),
  );
  return fits.length === 1 ? fits[0] : undefined;
}

/** `wasp_walk.anim`: as its file is called, or would be. */
export function fileNameOf(character: Character, part: Part): string {
  return sourceOf(character, part)?.name ?? nameOf(part);
}

/** The files that saving a character as `kind` gives: none where it has nothing of it, several for several morphs. */
export function saveCharacter(character: Character, kind: FileKind): readonly SavedFile[] {
  if (kind === 'rig') return [write(`${character.name}.rig`, { kind, rig: rigOf(character) })];
  const parts = partsOf(character).filter((p) => p.kind === kind);
  return parts.map((part) => write(nameOf(part), contentOf(part, jointPose(character))));
}

/** One part as the text of its file; a skeleton in the pose given, one value for each DOF of its joints. */
export function savePart(part: Part, name: string, pose: readonly number[]): SavedFile {
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

function contentOf({ kind, part }: Part, pose: readonly number[]): FileContent {
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

/** The skeleton with a pose of its joints as the file's. */
function inPose(skeleton: Skeleton, pose: readonly number[]): Skeleton {
  const first = firstDofs(skeleton);
  const joints = skeleton.joints.map((joint, index) => {
    const start = first[index] - rootDofCount(skeleton);
    return { ...joint, pose: pose.slice(start, start + dofsOf(joint.motion).length) };
  });
  return { ...skeleton, joints };
}

function rigOf({ name, skeleton, skins, shownSkin, morphs, clips, shownClip }: Character): Rig {
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
