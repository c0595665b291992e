/**
 * Sessions kept before parts had an identity: a part's file was found by name, and a part counted as saved if it was
 * the very object that had been read or written.
 */

import type { SavedCharacter } from '../../files/save/saved-parts.ts';
import { partsOf } from '../../model/character-parts.ts';
import { type Character, isBvh } from '../../model/document.ts';
import { type PartKind, type SourceFile, stemOf } from '../../model/files.ts';
import type { Part, PartMark } from '../../model/part.ts';
import { UNMARKED } from '../../model/part.ts';
import type { KeptMarks, KeptState } from './session-state.ts';

/** Saving state of version 1. */
interface Saving1 {
  readonly marks?: {
    readonly characters: readonly {
      readonly characterId: string;
      readonly parts: readonly { readonly kind: PartKind; readonly part: object }[];
      readonly pose: readonly number[];
    }[];
  };
  readonly disk?: KeptMarks['disk'];
}

/** The state in the present form. */
export function fromVersion1(state: KeptState): KeptState {
  const { document } = state;
  // Written by version 1.
  const { marks, disk = [] } = (state.saving ?? {}) as Saving1;
  const characters = document.characters.map(withMarks);
  const saved = characters.map((character): SavedCharacter => {
    const known = marks?.characters.find(({ characterId }) => characterId === character.id);
    const isSaved = (part: Part) =>
      known?.parts.some((own) => own.kind === part.kind && isSameContent(own.part, part)) ?? false;
    return { characterId: character.id, parts: partsOf(character).map(isSaved), pose: known?.pose ?? [] };
  });
  const saving: KeptMarks = { saved, disk };
  return { ...state, document: { ...document, characters }, saving };
}

function withMarks(character: Character): Character {
  const { name, sources, skeleton, skins, morphs, clips, poses } = character;
  const mark = (kind: PartKind, holds: string): PartMark => {
    const source = sourceOf(sources, kind, holds, skeleton?.name);
    return source ? { ...UNMARKED, file: { kind, source, holds } } : UNMARKED;
  };
  const own = isBvh(character) ? 'bvh' : 'skel';
  const parts = {
    ...(skeleton && { skeleton: mark(own, skeleton.name) }),
    skins: skins.map((skin) => mark('skin', skin.name)),
    morphs: morphs.map((morph) => mark('morph', morph.name)),
    clips: clips.map((clip) => {
      const animation = mark('anim', clip.name);
      return own === 'bvh' && !animation.file ? mark('bvh', clip.name) : animation;
    }),
    ...(poses && { poses: mark('pose', name) }),
  };
  return { ...character, parts };
}

/** The only file of that kind and name. */
function sourceOf(
  sources: readonly SourceFile[],
  kind: PartKind,
  name: string,
  skeleton: string | undefined,
): SourceFile | undefined {
  const isOfKind = new RegExp(`\\.${kind === 'skel' ? '(ax)?skel' : kind}$`, 'i');
  const fits = sources.filter((source) => {
    if (!isOfKind.test(source.name)) return false;
    const isRootOf = kind === 'bvh' && name === skeleton && name.startsWith(stemOf(source));
    return kind === 'skel' || kind === 'pose' || stemOf(source) === name || isRootOf;
  });
  return fits.length === 1 ? fits[0] : undefined;
}

/** Values shared in a session are shared again when restored. */
function isSameContent(kept: object, { kind, content }: Part): boolean {
  if (kind === 'bvh') {
    const take: Partial<typeof content> = kept;
    return take.skeleton === content.skeleton && take.clip === content.clip;
  }
  if (kind !== 'pose') return kept === content;
  const library: Partial<typeof content> = kept;
  return library.poses === content.poses;
}
