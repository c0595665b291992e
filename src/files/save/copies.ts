/**
 * The files of a character in formats other than its own: `.skel` and `.anim` of motion capture, `.bvh` of any skeleton
 * and take, either form of skeletons, a `.rig` with the names of the others. Saving them marks nothing as saved.
 */
import type { SampleKeyOptions } from '../../edit/convert/keys-of-samples.ts';
import { joinedRoots } from '../../evaluate/acclaim-bones.ts';
import { fitOneBvh } from '../../formats/bvh/write.ts';
import { partsOf } from '../../model/character-parts.ts';
import type { Diagnostic } from '../../model/diagnostic.ts';
import { type Character, isOfJoints } from '../../model/document.ts';
import type { Capture, FileContent } from '../../model/files.ts';
import { newFileName } from '../../model/part.ts';
import type { Rig } from '../../model/rig.ts';
import { axisAngleObstacle, inAxisAngleForm, inHierarchyForm } from '../../model/skeleton/axis-angle.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { MARKERS_EXTENSION } from '../../model/takes/markers.ts';
import type { Take } from '../../model/takes/take.ts';
import { acclaimOf, animOf, bvhOf, type NamedCapture, skelOf, withoutBones } from './character-files.ts';

/** A file to be written, as a model. */
export interface Copy {
  readonly name: string;
  /** Made when it is written. */
  content(): FileContent;
  /** Losses on the way to the model. */
  readonly diagnostics?: readonly Diagnostic[];
}

/** Options of writing a character in another format. */
export interface ConversionOptions extends SampleKeyOptions {
  /** Frame rate of `.bvh`; absent: each take's own, or 30. */
  readonly framesPerSecond?: number;
}

/** The skeleton, in hierarchy form unless `inForm` says otherwise; none without one. */
export function skelCopies(
  character: Character,
  _options?: ConversionOptions,
  inForm: (skeleton: Skeleton) => Skeleton = inHierarchyForm,
): readonly Copy[] {
  const skeleton = skelOf(withoutBones(character));
  if (!skeleton) return [];
  return [{ name: `${skeleton.name}.skel`, content: () => ({ kind: 'skel', skeletons: [inForm(skeleton)] }) }];
}

/** The skeleton in axis-angle form; none if it does not fit into it. */
export function axskelCopies(character: Character): readonly Copy[] {
  const skeleton = skelOf(withoutBones(character));
  if (!skeleton || axisAngleObstacle(skeleton) !== undefined) return [];
  return [
    { name: `${skeleton.name}.axskel`, content: () => ({ kind: 'skel', skeletons: [inAxisAngleForm(skeleton)] }) },
  ];
}

/** All takes, with keys. */
export function animCopies(character: Character, options: ConversionOptions): readonly Copy[] {
  const plain = withoutBones(character);
  return plain.takes.map((take) => ({
    name: `${take.name}.anim`,
    content: () => ({ kind: 'anim', take: animOf(plain, take, options) }),
  }));
}

/** All takes, or the pose without one. Refuses, with a `CommandError`, more frames than can be sampled. */
export function bvhCopies(character: Character, { framesPerSecond }: ConversionOptions): readonly Copy[] {
  return bvhOf(character, framesPerSecond).map((capture) => bvhCopy(`${capture.name}.bvh`, [capture]));
}

/**
 * An Acclaim skeleton with all takes, each called so that it is found to belong to it.
 * @param stem of the skeleton, and of the only take; of several takes the beginning
 */
export function acclaimCopies(
  character: Character,
  { framesPerSecond }: ConversionOptions,
  stem?: string,
): readonly Copy[] {
  const hasTakes = character.takes.length > 0 || character.driver !== undefined;
  return acclaimFiles(acclaimOf(character, framesPerSecond), hasTakes, stem);
}

/**
 * Roots of one file as one Acclaim skeleton, with the take that they share; undefined if they are of Acclaim already,
 * or have other frames or several takes. Refuses as `bvhCopies`.
 * @param stem as of `acclaimCopies`
 */
export function acclaimRootsCopies(
  characters: readonly Character[],
  { framesPerSecond }: ConversionOptions,
  stem: string,
): readonly Copy[] | undefined {
  if (characters.some((character) => isOfJoints(character, 'asf'))) return undefined;
  const roots = characters.flatMap((character) => acclaimOf(character, framesPerSecond));
  const captures = roots.map(({ capture }) => capture);
  if (roots.length !== characters.length || !fitOneBvh(captures)) return undefined;
  const diagnostics = roots.flatMap((root) => root.diagnostics);
  const hasTakes = characters.some(({ takes }) => takes.length > 0);
  return acclaimFiles([{ name: stem, capture: joinedRoots(captures), diagnostics }], hasTakes, stem);
}

function acclaimFiles(made: readonly NamedCapture[], hasTakes: boolean, stem: string | undefined): readonly Copy[] {
  const [first] = made;
  if (!first) return [];
  const { skeleton } = first.capture;
  const base = stem ?? skeleton.name;
  const own = (name: string) => (stem === undefined && name.startsWith(base) ? name : `${base}_${name}`);
  const named = (name: string) => (stem !== undefined && made.length === 1 ? base : own(name));
  const takes = hasTakes ? made : [];
  return [
    { name: `${base}.asf`, content: () => ({ kind: 'asf', skeleton }), diagnostics: first.diagnostics },
    ...takes.map((take) => amcCopy(`${named(take.name)}.amc`, { ...take.capture, skeleton })),
  ];
}

/** A take of an Acclaim skeleton as a file. */
export function amcCopy(name: string, { skeleton, take }: Capture): Copy {
  return { name, content: () => ({ kind: 'amc', skeleton, take: take ?? STILL }) };
}

/** A take of one frame, at rest. */
const STILL: Take = { name: '', range: [0, 0], channels: [] };

/** Several captures with the same frames as one file. */
export function bvhCopy(name: string, captures: readonly NamedCapture[]): Copy {
  return {
    name,
    content: () => ({ kind: 'bvh', captures: captures.map(({ capture }) => capture) }),
    diagnostics: captures.flatMap(({ diagnostics }) => diagnostics),
  };
}

/** A file for each take that has markers, called after it. */
export function markersCopies({ takes }: Pick<Character, 'takes'>): readonly Copy[] {
  return takes.flatMap(({ name, markers }) =>
    markers ? [{ name: `${name}.${MARKERS_EXTENSION}`, content: () => ({ kind: 'markers', markers }) }] : [],
  );
}

/** The names of the files of its own parts. */
export function rigCopies(character: Character): readonly Copy[] {
  return [{ name: `${character.name}.rig`, content: () => ({ kind: 'rig', rig: rigOf(character) }) }];
}

function rigOf(character: Character): Rig {
  const { name, skins, shownSkin, morphs, takes, shownTake } = character;
  const skeleton = partsOf(character).find(({ kind }) => kind === 'skel');
  const skin = skins[shownSkin];
  const take = takes[shownTake];
  return {
    name,
    ...(skeleton && { skeleton: newFileName(skeleton) }),
    ...(skin && { skin: `${skin.name}.skin` }),
    morphs: morphs.map((morph) => `${morph.name}.morph`),
    ...(take && { animation: `${take.name}.anim` }),
  };
}
