/**
 * A character's parts as files again, each in the format of its kind (`model/part.ts`). In the formats that are not its
 * own it is converted (`conversion.ts`): a copy, by which nothing counts as saved.
 *
 * A skeleton that was read from the axis-angle form is kept in that form as long as it fits into it; each form is a
 * conversion of the other.
 */

import { fitOneBvh } from '../../formats/bvh/write.ts';
import { partsOf } from '../../model/character-parts.ts';
import type { Character } from '../../model/document.ts';
import type { FileContent } from '../../model/files.ts';
import { newFileName, type Part } from '../../model/part.ts';
import type { Rig } from '../../model/rig.ts';
import { type FormatKind, KINDS } from '../kinds.ts';
import { bvhOf, hasOwnRate, inPose } from './character-files.ts';
import { CONVERSIONS } from './conversion.ts';
import { bvhOutput, type Output, type SavedFile, textOf, textOutput } from './output.ts';
import { isExport, jointPose, posesByNames } from './own-formats.ts';

export interface SavingOptions {
  /** Of `.bvh`, for clips that have no rate of their own; absent: 30. */
  readonly framesPerSecond?: number;
}

/** The files that saving a character as `kind` gives: none where it has nothing of it, several for several morphs. */
export function saveCharacter(
  character: Character,
  kind: FormatKind,
  options: SavingOptions = {},
): readonly SavedFile[] {
  if (isCopy(character, kind)) return copiesOf(character, kind, options).map(textOf);
  const pose = jointPose(character);
  return partsOfKind(character, kind).map((part) =>
    textOf(writeParts(newFileName(part), [{ character, part, pose }], options)),
  );
}

/** Whether a file of that kind is nothing that a character has as a part of its own: a rig, or what it is converted to. */
export function isCopy(character: Character, kind: FormatKind): boolean {
  return kind === 'rig' || isExport(character, kind);
}

/** Files by which nothing counts as saved. */
export function copiesOf(character: Character, kind: FormatKind, options: SavingOptions = {}): readonly Output[] {
  if (kind === 'rig') return [textOutput(`${character.name}.rig`, () => ({ kind, rig: rigOf(character) }))];
  return CONVERSIONS[kind]?.(character, haveOwnRates(character) ? {} : options) ?? [];
}

export function partsOfKind(character: Character, kind: FormatKind): readonly Part[] {
  return partsOf(character).filter((part) => part.kind === KINDS[kind].content);
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
export function writeParts(name: string, owned: readonly Owned[], options: SavingOptions = {}): Output {
  const [{ part }] = owned;
  if (part.kind === 'bvh') return takesOutput(name, owned, options);
  return textOutput(name, () => contentOf(part, owned));
}

/** What a file of parts other than takes holds. */
function contentOf(part: Exclude<Part, { readonly kind: 'bvh' }>, owned: readonly Owned[]): FileContent {
  switch (part.kind) {
    case 'skel': {
      const skeletons = owned.flatMap(({ part: own, pose }) =>
        own.kind === 'skel' ? [inPose(own.content, pose)] : [],
      );
      return { kind: 'skel', skeletons };
    }
    case 'skin':
      return { kind: 'skin', skin: part.content };
    case 'morph':
      return { kind: 'morph', morph: part.content };
    case 'anim':
      return { kind: 'anim', clip: part.content };
    case 'pose':
      return { kind: 'pose', poses: posesByNames(part.content) };
  }
}

function takesOutput(name: string, roots: readonly Owned[], { framesPerSecond }: SavingOptions): Output {
  const figures = roots.flatMap(({ character: { driver: _, ...character }, part }) => {
    if (part.kind !== 'bvh') return [];
    // The take itself, whatever else moves the character just now.
    const { clip } = part.content;
    const rate = clip && hasOwnRate(clip) ? undefined : framesPerSecond;
    return bvhOf({ ...character, clips: clip ? [clip] : [], shownClip: clip ? 0 : -1 }, rate);
  });
  if (!fitOneBvh(figures.map(({ figure }) => figure))) {
    throw new Error(
      `The figures of ${name} now have different frames, but one .bvh file needs the same frames for all: ` +
        'trim and resample them to match, or rename the takes to save each one separately.',
    );
  }
  return bvhOutput(name, figures);
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
