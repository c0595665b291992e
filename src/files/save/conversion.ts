/**
 * Converts characters to formats other than their own: `.skel` and `.anim` of motion capture, `.bvh` of any skeleton
 * and take, either form of skeletons. Characters from one BVH file are written to one file if possible: several roots
 * with the same frames.
 */

import { withFlattenedTakes } from '../../edit/layers/flatten.ts';
import { withPlainTakes } from '../../edit/limbs/plain-takes.ts';
import { fitOneBvh } from '../../formats/bvh/write.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import { type SourceFile, stemOf } from '../../model/files.ts';
import { nameByInput } from '../../model/names/telling-names.ts';
import { NO_MARKS, newFileName } from '../../model/part.ts';
import { bonesObstacle } from '../../model/points.ts';
import { inHierarchyForm } from '../../model/skeleton/axis-angle.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { formatKindOf, KINDS } from '../kinds.ts';
import { bvhOf } from './character-files.ts';
import {
  acclaimCopies,
  acclaimRootsCopies,
  animCopies,
  bvhCopy,
  type ConversionOptions,
  rigCopies,
  skelCopies,
} from './copies.ts';
import { type Output, outputOf } from './output.ts';
import { partsOfKind, writeParts } from './saving.ts';

/** Formats to which any character with a skeleton can be converted, of points `trc` alone. */
export const TARGETS = ['skel', 'anim', 'bvh', 'asf', 'rig', 'trc'] as const;
/** A format that characters are converted to; see `TARGETS`. */
export type Target = (typeof TARGETS)[number];

/** Why a character can't be converted to a format, as a sentence; undefined if it can. */
export function targetObstacle(character: Character, target: Target): string | undefined {
  if (target !== 'trc') return bonesObstacle(character);
  return KINDS.trc.save.has(character) ? undefined : `${character.name} has no points, which alone are saved as .trc.`;
}

/** The file from which something of this name was read: the skeleton's, or a take's. */
export function sourceFor({ takes, parts }: Character, name: string): SourceFile | undefined {
  const skeleton = parts?.skeleton?.file?.source;
  if (skeleton && stemOf(skeleton) === name) return skeleton;
  return parts?.takes[takes.findIndex((take) => take.name === name)]?.file?.source ?? skeleton;
}

/**
 * The files of characters converted to `target`: for `skel` the skeleton and its takes, for `anim` only the takes.
 * Characters without a skeleton give none.
 */
export function outputsOf(
  given: readonly Character[],
  target: Target,
  options: ConversionOptions = {},
): readonly Output[] {
  // Frames are evaluated, which solves goals and attachments.
  const hasFrames = target === 'bvh' || target === 'asf' || target === 'trc';
  const characters = given.map((one) => (hasFrames ? withFlattenedTakes : withPlainTakes)(one, options));
  if (target === 'bvh') return bvhOutputs(characters, options);
  if (target === 'asf') return acclaimOutputs(characters, options);
  if (target === 'trc') return characters.flatMap((character) => pointOutputs(character, options));
  return characters.flatMap((character) => {
    if (!character.skeleton) return [];
    const takes = animCopies(character, options).map(outputOf);
    if (target === 'anim') return takes;
    if (target === 'rig') return [...skelCopies(character, options).map(outputOf), ...partOutputs(character), ...takes];
    // A different extension asks for the hierarchy form of all `.skel` files.
    const readAs = formatKindOf(character.parts?.skeleton?.file?.source.name ?? '');
    const inForm = readAs === 'axskel' ? inHierarchyForm : (skeleton: Skeleton) => skeleton;
    return [...skelCopies(character, options, inForm).map(outputOf), ...takes];
  });
}

/** Its takes of points. */
function pointOutputs(character: Character, options: ConversionOptions): readonly Output[] {
  return partsOfKind(character, 'trc').map((part) =>
    writeParts(newFileName(part), [{ character, part, pose: [] }], options),
  );
}

/** All that a `.rig` names besides the skeleton and the takes, with textures, and the `.rig` itself. */
function partOutputs(character: Character): readonly Output[] {
  const { skins, morphs, textures } = character;
  const parts = [
    ...skins.map((skin) => ({ name: `${skin.name}.skin`, content: () => ({ kind: 'skin', skin }) as const })),
    ...morphs.map((morph) => ({ name: `${morph.name}.morph`, content: () => ({ kind: 'morph', morph }) as const })),
    ...rigCopies(character),
  ].map(outputOf);
  const images = textures.map(({ name, bytes }): Output => ({ name, pieces: () => [bytes], diagnostics: () => [] }));
  return [...parts, ...images];
}

/**
 * The character with its takes named after it, for folders with files of many characters: takes that came in a file of
 * whole characters, of which each may have one called Idle, and all that a `.rig` names.
 */
export function withOwnNames(character: Character, target: Target): Character {
  const { skeleton, takes, morphs, parts = NO_MARKS } = character;
  const isRig = target === 'rig';
  const name = isRig ? character.name : (skeleton?.name ?? character.name);
  const isInside = (take: number) => parts.takes[take]?.file?.kind === 'character';
  const isOnly = takes.length === 1 && isInside(0);
  return {
    ...character,
    takes: takes.map((take, i) =>
      isRig || isInside(i) ? { ...take, name: nameByInput({ name: take.name, isOnly }, name) } : take,
    ),
    ...(isRig && { morphs: morphs.map((morph) => ({ ...morph, name: nameByInput(morph, name) })) }),
  };
}

/** The character with another name for its skeleton, and for what is named after that. */
export function renamedTo(character: Character, skeleton: Skeleton, name: string): Character {
  const own = skeleton.name.toLowerCase();
  const isNamedAfter = (part: string) =>
    own !== '' && part.toLowerCase().startsWith(own) && /^(?:[_.\- ]|$)/.test(part.slice(own.length));
  const renamed = <T extends { readonly name: string }>(part: T): T =>
    isNamedAfter(part.name) ? { ...part, name: name + part.name.slice(skeleton.name.length) } : part;
  const { skins, morphs, takes } = character;
  return {
    ...renamed(character),
    skeleton: { ...skeleton, name },
    skins: skins.map(renamed),
    morphs: morphs.map(renamed),
    takes: takes.map(renamed),
  };
}

/** A take of each character, as roots of one file if they have the same frames. */
function bvhOutputs(characters: readonly Character[], options: ConversionOptions): readonly Output[] {
  const all = characters.map((character) => bvhOf(character, options.framesPerSecond));
  const first = all.map(([capture]) => capture);
  const isOneFile = all.length > 1 && all.every((captures) => captures.length === 1);
  if (isOneFile && sameSource(characters) && fitOneBvh(first.map(({ capture }) => capture))) {
    const [source] = characters[0].sources;
    return [outputOf(bvhCopy(`${stemOf(source)}.bvh`, first))];
  }
  return all.flat().map((capture) => outputOf(bvhCopy(`${capture.name}.bvh`, [capture])));
}

/** Roots of one file as one skeleton if possible, and else each by itself. */
function acclaimOutputs(characters: readonly Character[], options: ConversionOptions): readonly Output[] {
  const isOneFile = characters.length > 1 && sameSource(characters);
  const roots = isOneFile ? acclaimRootsCopies(characters, options, stemOf(characters[0].sources[0])) : undefined;
  return (roots ?? characters.flatMap((character) => acclaimCopies(character, options))).map(outputOf);
}

function sameSource(characters: readonly Character[]): boolean {
  const path = characters[0]?.sources[0]?.path;
  return path !== undefined && characters.every(({ sources }) => sources.length === 1 && sources[0].path === path);
}

/** A diagnostic that says, in a sentence, why a file can't be written. */
export function refusal(code: string, message: string, file: string): Diagnostic {
  return withoutPlace('error', code, message, file);
}
