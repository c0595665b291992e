/** A character's parts as files again, each in the format of its kind. */
import { formatOf } from '../formats/registry.ts';
import { zipFiles } from '../io/zip-files.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import type { Character } from '../model/document.ts';
import { firstDofs } from '../model/dofs.ts';
import type { FileContent, FileKind } from '../model/files.ts';
import type { Rig } from '../model/rig.ts';
import { dofsOf, type Skeleton } from '../model/skeleton.ts';

export interface SavedFile {
  readonly name: string;
  readonly text: string;
  /** Names that had to be changed for the format. */
  readonly diagnostics: readonly Diagnostic[];
}

/** The files that saving a character as `kind` gives: none where it has nothing of it, several for several morphs. */
export function saveCharacter(character: Character, kind: FileKind): readonly SavedFile[] {
  const saved: SavedFile[] = [];
  for (const { name, content } of partsOf(character, kind)) {
    const written = formatOf(name)?.write(content, name);
    if (written) saved.push({ name, ...written });
  }
  return saved;
}

const KINDS: readonly FileKind[] = ['skel', 'skin', 'morph', 'anim', 'rig'];

/** Everything of a character, its textures too: what opens again as it is. */
export function zipCharacter(character: Character): { readonly name: string; readonly bytes: Uint8Array<ArrayBuffer> } {
  const texts = KINDS.flatMap((kind) => saveCharacter(character, kind)).map(({ name, text }) => ({
    name,
    content: text,
  }));
  const textures = character.textures.map(({ name, bytes }) => ({ name, content: bytes }));
  // A name may be anything; what the file system would take for a folder is no part of it.
  const folder = character.name.replace(/[/\\:]/g, '_') || 'character';
  return { name: `${folder}.zip`, bytes: zipFiles(folder, [...texts, ...textures]) };
}

/** What a character would be saved as, under the names of the files it came from. */
function partsOf(character: Character, kind: FileKind): { name: string; content: FileContent }[] {
  const { skeleton, skins, morphs, clips } = character;
  switch (kind) {
    case 'skel':
      if (!skeleton) return [];
      return [{ name: `${skeleton.name}.skel`, content: { kind, skeletons: [inPose(skeleton, character.pose)] } }];
    case 'skin':
      return skins.map((skin) => ({ name: `${skin.name}.skin`, content: { kind, skin } }));
    case 'morph':
      return morphs.map((morph) => ({ name: `${morph.name}.morph`, content: { kind, morph } }));
    case 'anim':
      return clips.map((clip) => ({ name: `${clip.name}.anim`, content: { kind, clip } }));
    case 'rig':
      return [{ name: `${character.name}.rig`, content: { kind, rig: rigOf(character) } }];
    case 'texture':
      return [];
  }
}

/** The skeleton with the character's pose as the file's. */
function inPose(skeleton: Skeleton, pose: readonly number[]): Skeleton {
  const first = firstDofs(skeleton);
  const joints = skeleton.joints.map((joint, index) => ({
    ...joint,
    pose: pose.slice(first[index], first[index] + dofsOf(joint.motion).length),
  }));
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
