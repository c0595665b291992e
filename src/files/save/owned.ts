/** The parts that are saved in one file. */
import { partsOf } from '../../model/character-parts.ts';
import type { Character, Document } from '../../model/document.ts';
import type { Part } from '../../model/part.ts';

/** A part with its character, and the pose to write if it is a skeleton: one value per DOF of its joints. */
export interface Owned {
  readonly character: Character;
  readonly part: Part;
  readonly pose: readonly number[];
}

/** The part of a character's pose that is written to its skeleton's file: one value per DOF of the joints. */
export type PoseOf = (character: Character) => readonly number[];

/** The parts whose own file has a path, in document order. */
export function ownedIn({ characters }: Document, path: string, poseOf: PoseOf): readonly Owned[] {
  return characters.flatMap((character) =>
    partsOf(character)
      .filter((part) => part.file?.path === path)
      .map((part) => ({ character, part, pose: part.kind === 'skel' ? poseOf(character) : [] })),
  );
}
