/**
 * Writes a character's parts to files, each in the format of its kind (`model/part.ts`). For other formats it is
 * converted (`copies.ts`) to a copy, which marks nothing as saved.
 *
 * A skeleton read from the axis-angle form keeps that form as long as it fits; each form can be converted to the other.
 */

import { withFlattenedTakes } from '../../edit/layers/flatten.ts';
import { withPlainTakes } from '../../edit/limbs/plain-takes.ts';
import { fitOneBvh } from '../../formats/bvh/write.ts';
import { partsOf } from '../../model/character-parts.ts';
import type { Character } from '../../model/document.ts';
import type { FileContent } from '../../model/files.ts';
import { newFileName, type Part, takeOf } from '../../model/part.ts';
import { setsByName } from '../../model/sets-by-name.ts';
import { skelChannels } from '../../model/skeleton/skel-motion.ts';
import { unlayered } from '../../model/takes/layers.ts';
import { baseOf, hasControls, type Take } from '../../model/takes/take.ts';
import { besideOf, KINDS, type SavedKind } from '../kinds.ts';
import { WRITERS, type Writer } from '../writers.ts';
import { acclaimOf, bvhOf, hasOwnRate, inPose, pointsOf } from './character-files.ts';
import { amcCopy, bvhCopy } from './copies.ts';
import { limbsFile, plainTake } from './layers.ts';
import { type Output, outputOf, type SavedFile, savedFileOf } from './output.ts';
import type { Owned } from './owned.ts';
import { jointPose, posesByNames } from './saved-poses.ts';

/** Options of writing a character in its own formats. */
export interface SavingOptions {
  /** Frame rate of `.bvh`, for takes without a rate of their own; absent: 30. */
  readonly framesPerSecond?: number;
}

/** The files from saving a character as `kind`: none if it has no such content, several for several morphs. */
export function saveCharacter(
  character: Character,
  kind: SavedKind,
  options: SavingOptions = {},
): readonly SavedFile[] {
  if (isCopy(character, kind)) return copiesOf(character, kind, options).map(savedFileOf);
  const pose = jointPose(character);
  return partsOfKind(character, kind).map((part) =>
    savedFileOf(writeParts(newFileName(part), [{ character, part, pose }], options)),
  );
}

/** Whether files of that kind are copies, not parts of the character: a rig, or a conversion. */
export function isCopy(character: Character, kind: SavedKind): boolean {
  return !KINDS[kind].save.isOwn(character);
}

/** Copies, which mark nothing as saved. */
export function copiesOf(character: Character, kind: SavedKind, options: SavingOptions = {}): readonly Output[] {
  const { copies }: Writer<never> = WRITERS[kind];
  return copies?.(forCopies(character, kind, options), haveOwnRates(character) ? {} : options).map(outputOf) ?? [];
}

/** The character whose takes a format can hold. */
function forCopies(character: Character, kind: SavedKind, options: SavingOptions): Character {
  // Files beside those of takes say what others can't.
  if (besideOf(kind) === 'take') return character;
  // Frames are evaluated, which solves goals and attachments.
  const hasFrames = kind === 'bvh' || kind === 'asf' || kind === 'amc';
  return (hasFrames ? withFlattenedTakes : withPlainTakes)(character, options);
}

/** The parts of a character that are saved in files of a kind. */
export function partsOfKind(character: Character, kind: SavedKind): readonly Part[] {
  return partsOf(character).filter((part) => part.kind === KINDS[kind].content);
}

/** Whether all its takes have a frame rate of their own. */
function haveOwnRates({ takes, driver }: Character): boolean {
  if (driver) return hasOwnRate(driver.source.take);
  return takes.length > 0 && takes.every(hasOwnRate);
}

/**
 * Writes parts to one file: several skeletons or takes, one root each, or a single part of another kind.
 * @throws Error, in a sentence, if roots of one `.bvh` no longer have the same frames
 */
export function writeParts(name: string, owned: readonly Owned[], options: SavingOptions = {}): Output {
  const [{ part }] = owned;
  if (part.kind === 'bvh') return takesOutput(name, owned, options);
  if (part.kind === 'amc') return acclaimOutput(name, owned[0], options);
  return outputOf({ name, content: () => contentOf(part, owned, name) });
}

/** The content of a file of parts other than takes. */
function contentOf(
  part: Exclude<Part, { readonly kind: 'bvh' | 'amc' }>,
  owned: readonly Owned[],
  name: string,
): FileContent {
  switch (part.kind) {
    case 'skel': {
      const skeletons = owned.flatMap(({ part: own, pose }) =>
        own.kind === 'skel' ? [inPose(own.content, pose)] : [],
      );
      return { kind: 'skel', skeletons };
    }
    case 'asf':
      return { kind: 'asf', skeleton: part.content };
    case 'skin':
      return { kind: 'skin', skin: part.content };
    case 'morph':
      return { kind: 'morph', morph: part.content };
    case 'anim': {
      const [{ character }] = owned;
      const { skeleton, pose } = character;
      const { take } = plainTake(character, part.content, '');
      if (!skeleton) return { kind: 'anim', take };
      // The joints of motion capture have their DOFs in another order there.
      return { kind: 'anim', take: skelChannels(take, skeleton, pose) };
    }
    case 'trc': {
      const [{ character }] = owned;
      const { space } = character;
      const capture = pointsOf(character, beneathControls(part.content.take));
      return { kind: 'trc', capture, ...(space && { space: { space, standing: 0 } }) };
    }
    case 'pose':
      return { kind: 'pose', poses: posesByNames(part.content) };
    case 'sets':
      return { kind: 'sets', sets: setsByName(part.content.sets, part.content.skeleton) };
    case 'limbs': {
      const [{ character }] = owned;
      return { kind: 'limbs', limbs: limbsFile(character, part.content, name) };
    }
  }
}

/** A take of Acclaim bones: its own samples, or what its keys give. */
function acclaimOutput(name: string, { character, part }: Owned, { framesPerSecond }: SavingOptions): Output {
  const { driver: _, ...own } = character;
  const take = beneathControls(takeOf(part));
  const rate = take && hasOwnRate(take) ? undefined : framesPerSecond;
  const [made] = acclaimOf({ ...own, takes: take ? [take] : [], shownTake: take ? 0 : -1 }, rate);
  return outputOf({ ...amcCopy(name, made.capture), diagnostics: made.diagnostics });
}

function takesOutput(name: string, roots: readonly Owned[], { framesPerSecond }: SavingOptions): Output {
  const captures = roots.flatMap(({ character: { driver: _, ...character }, part }) => {
    if (part.kind !== 'bvh') return [];
    // The take itself, even while another one is retargeted to the character.
    const take = beneathControls(part.content.take);
    const rate = take && hasOwnRate(take) ? undefined : framesPerSecond;
    return bvhOf({ ...character, takes: take ? [take] : [], shownTake: take ? 0 : -1 }, rate);
  });
  if (!fitOneBvh(captures.map(({ capture }) => capture))) {
    throw new Error(
      `The skeletons in ${name} now have different frames, but one .bvh file needs the same frames for all: ` +
        'trim and resample them to match, or rename the takes to save each one separately.',
    );
  }
  return outputOf(bvhCopy(name, captures));
}

/** What the own file of a captured take holds: layers, goals and attachments are beside it. */
function beneathControls(take: Take | undefined): Take | undefined {
  if (!take || !hasControls(take)) return take;
  const { goals: _goals, attached: _attached, ...own } = take;
  return own.layers ? unlayered(own, baseOf(own)) : own;
}
