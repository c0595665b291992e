/**
 * `marrow/formats`: readers and writers of every text format. Readers never throw for anything that a file holds: its
 * problems are in `diagnostics`, with line and column, and what has an error is absent.
 *
 *     const { skeleton, diagnostics } = readSkel(text, 'wasp.skel');
 *     if (!skeleton) for (const { line, column, message } of diagnostics) …
 *
 * Names of what is read are those of the files, without the extension.
 */
import { capturedContent } from '../files/captured.ts';
import { formatOf } from '../files/readers.ts';
import { readAmc as amcTake } from '../formats/acclaim/read-amc.ts';
import { asfReader } from '../formats/acclaim/read-asf.ts';
import { writeAmc as amcPieces } from '../formats/acclaim/write-amc.ts';
import { animReader } from '../formats/anim/read.ts';
import { bvhReader } from '../formats/bvh/read.ts';
import { writeBvh as bvhPieces } from '../formats/bvh/write.ts';
import { isWorthDiagnosing } from '../formats/diagnose/diagnose.ts';
import { foldUnreadable } from '../formats/diagnose/fold.ts';
import { stemOfName } from '../formats/grammar.ts';
import { markersReader } from '../formats/markers/read.ts';
import { morphReader } from '../formats/morph/read.ts';
import { poseReader } from '../formats/pose/read.ts';
import {
  bytesReader,
  type Reader,
  type ReadResult,
  readWhole,
  type WriteResult,
  type WrittenPieces,
} from '../formats/reader.ts';
import { rigReader } from '../formats/rig/read.ts';
import { hierarchyReader } from '../formats/skel/read-hierarchy.ts';
import { parentsReader } from '../formats/skel/read-parents.ts';
import { writeSkel as skelText } from '../formats/skel/write.ts';
import { skinReader } from '../formats/skin/read.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import type { Capture } from '../model/files.ts';
import type { Morph } from '../model/morph.ts';
import type { PoseByNames } from '../model/pose-by-names.ts';
import type { Rig } from '../model/rig.ts';
import { withPositions } from '../model/skeleton/position-channels.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Skin } from '../model/skin.ts';
import type { Space } from '../model/space.ts';
import type { Marker } from '../model/takes/markers.ts';
import type { Take } from '../model/takes/take.ts';
import { bytesOf, type Content } from './content.ts';

export { writeAsf } from '../formats/acclaim/write-asf.ts';
export { writeAnim } from '../formats/anim/write.ts';
export { writeMarkers } from '../formats/markers/write.ts';
export { writeMorph } from '../formats/morph/write.ts';
export { writePoses } from '../formats/pose/write.ts';
export type { WriteResult } from '../formats/reader.ts';
export { writeRig } from '../formats/rig/write.ts';
export { writeSkin } from '../formats/skin/write.ts';
export type { Diagnostic } from '../model/diagnostic.ts';
export type { Content } from './content.ts';

/** The messages of a reader: errors, warnings, remarks; empty for a file without problems. */
export interface Diagnosed {
  readonly diagnostics: readonly Diagnostic[];
}

/** A skeleton that was read; absent if and only if there is an error. */
export interface ReadSkeleton extends Diagnosed {
  /** The first of `skeletons`. */
  readonly skeleton?: Skeleton;
  /** One for each root of the file; none if there is an error. */
  readonly skeletons: readonly Skeleton[];
}

/** Motion capture that was read; absent if and only if there is an error. */
export interface ReadCapture extends Diagnosed {
  /** Of the first of `captures`. */
  readonly skeleton?: Skeleton;
  /** Of the first of `captures`; absent of a file without frames, too. */
  readonly take?: Take;
  /** One for each root of the file; none if there is an error. */
  readonly captures: readonly Capture[];
  /** Unit, up axis and ground, guessed from how the body moves, for `createCharacter`. */
  readonly space?: Space;
}

function read<T>(reader: (fileName: string) => Reader<T>, content: Content, fileName: string): ReadResult<T> {
  return readWhole(reader(fileName), bytesOf(content));
}

/**
 * Reads a `.skel`, in its hierarchy or its axis-angle form.
 * @param fileName in messages, and the name of the skeleton
 * @throws UserError if `content` is neither text nor bytes, as all readers do
 */
export function readSkel(content: Content, fileName = ''): ReadSkeleton {
  return skeletonsIn(read(hierarchyReader, content, fileName));
}

/**
 * Reads a `.skel` with a joint on each line: `x y z PARENT`, the offset from the parent and its index, -1 for a root.
 * `readCharacters` of `marrow/import` tells by itself which form a file has.
 */
export function readSkelRows(content: Content, fileName = ''): ReadSkeleton {
  return skeletonsIn(read(parentsReader, content, fileName));
}

function skeletonsIn({ value: skeletons = [], diagnostics }: ReadResult<readonly Skeleton[]>): ReadSkeleton {
  return { ...(skeletons[0] && { skeleton: skeletons[0] }), skeletons, diagnostics };
}

/**
 * Problems at the places where they are, as the page shows them, without those that follow from others. Readers tell of a
 * problem where they can't continue, which may be far from it; here the file is read again, as each of the likely mistakes
 * would have it.
 * @param diagnostics from a reader of the same content
 * @param fileName its extension says the format; of others, the problems are returned as they are
 */
export function locateProblems(
  content: Content,
  fileName: string,
  diagnostics: readonly Diagnostic[],
): readonly Diagnostic[] {
  const bytes = bytesOf(content);
  const diagnose = isWorthDiagnosing(diagnostics, bytes.length) ? formatOf(fileName)?.diagnose : undefined;
  return foldUnreadable(diagnose ? diagnose(fileName, bytes, diagnostics) : diagnostics);
}

/** Reads a `.skin`. */
export function readSkin(content: Content, fileName = ''): Diagnosed & { readonly skin?: Skin } {
  const { value, diagnostics } = read(skinReader, content, fileName);
  return { ...(value && { skin: value }), diagnostics };
}

/** Reads a `.morph`. */
export function readMorph(content: Content, fileName = ''): Diagnosed & { readonly morph?: Morph } {
  const { value, diagnostics } = read(morphReader, content, fileName);
  return { ...(value && { morph: value }), diagnostics };
}

/** Reads a `.anim`. */
export function readAnim(content: Content, fileName = ''): Diagnosed & { readonly take?: Take } {
  const { value, diagnostics } = read(animReader, content, fileName);
  return { ...(value && { take: value }), diagnostics };
}

/** Reads a `.rig`: which files belong together. */
export function readRig(content: Content, fileName = ''): Diagnosed & { readonly rig?: Rig } {
  const { value, diagnostics } = read(rigReader, content, fileName);
  return { ...(value && { rig: value }), diagnostics };
}

/** Reads a `.pose`: poses by names of joints and DOFs. */
export function readPoses(content: Content, fileName = ''): Diagnosed & { readonly poses?: readonly PoseByNames[] } {
  const { value, diagnostics } = read(poseReader, content, fileName);
  return { ...(value && { poses: value }), diagnostics };
}

/** Reads a `.markers.json`: labels of times and spans of a take. */
export function readMarkers(content: Content, fileName = ''): Diagnosed & { readonly markers?: readonly Marker[] } {
  const { value, diagnostics } = read(markersReader, content, fileName);
  return { ...(value && { markers: value }), diagnostics };
}

/** Reads a `.bvh`, in any dialect. */
export function readBvh(content: Content, fileName = ''): ReadCapture {
  const { value, diagnostics } = read(bvhReader, content, fileName);
  if (!value) return { captures: [], diagnostics };
  const { value: given, diagnostics: guesses } = capturedContent(value, fileName);
  const { guessed } = given;
  const captures = given.captures.map(({ skeleton, ...rest }) => ({
    ...rest,
    skeleton: guessed ? withPositions(skeleton, guessed.positions) : skeleton,
  }));
  return {
    ...captures[0],
    captures,
    ...(guessed && { space: guessed.space }),
    diagnostics: [...diagnostics, ...guesses],
  };
}

/** Reads the skeleton of a `.asf` (Acclaim). */
export function readAsf(content: Content, fileName = ''): Diagnosed & { readonly skeleton?: Skeleton } {
  const { value, diagnostics } = read(asfReader, content, fileName);
  return { ...(value && { skeleton: value }), diagnostics };
}

/**
 * Reads the motion of a `.amc` (Acclaim).
 * @param skeleton of its `.asf`, whose bones it names
 */
export function readAmc(content: Content, skeleton: Skeleton, fileName = ''): Diagnosed & { readonly take?: Take } {
  const reader = (name: string) =>
    bytesReader(name, (bytes, report) => amcTake(bytes, report, stemOfName(name), skeleton));
  const { value, diagnostics } = read(reader, content, fileName);
  return { ...(value && { take: value }), diagnostics };
}

/** A file in pieces as one text. */
function textOf({ pieces, diagnostics }: WrittenPieces): WriteResult {
  const decoder = new TextDecoder();
  let text = '';
  for (const piece of pieces) text += decoder.decode(piece, { stream: true });
  return { text: text + decoder.decode(), diagnostics: diagnostics() };
}

/**
 * Writes a `.skel`. Numbers are the shortest that read back the same, as all writers have them.
 * @param skeletons one, or a root for each
 * @throws UserError for a number that is not finite, as all writers do
 */
export function writeSkel(skeletons: Skeleton | readonly Skeleton[], fileName = ''): WriteResult {
  return skelText('joints' in skeletons ? [skeletons] : skeletons, fileName);
}

/**
 * Writes a `.bvh`.
 * @param captures one, or a root for each: skeletons of BVH joints with sampled takes, as `readBvh` gives them
 */
export function writeBvh(captures: Capture | readonly Capture[], fileName = ''): WriteResult {
  return textOf(bvhPieces('skeleton' in captures ? [captures] : captures, fileName));
}

/** Writes a `.amc` (Acclaim): frames of a sampled take, with its skeleton. */
export function writeAmc(capture: Capture, fileName = ''): WriteResult {
  return textOf(amcPieces(capture, fileName));
}
