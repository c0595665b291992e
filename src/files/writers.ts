/** The writer of each kind of file, fetched when something is saved; readers are in `readers.ts`. */
import { writeAmc } from '../formats/acclaim/write-amc.ts';
import { writeAsf } from '../formats/acclaim/write-asf.ts';
import { writeAnim } from '../formats/anim/write.ts';
import { writeAttach } from '../formats/attach/write.ts';
import { writeBvh } from '../formats/bvh/write.ts';
import { writeLayers } from '../formats/layers/write.ts';
import { writeLimbs } from '../formats/limbs/write.ts';
import { writeMarkers } from '../formats/markers/write.ts';
import { writeMorph } from '../formats/morph/write.ts';
import { writePoses } from '../formats/pose/write.ts';
import type { WriteResult, WrittenPieces } from '../formats/reader.ts';
import { writeRig } from '../formats/rig/write.ts';
import { writeSets } from '../formats/sets/write.ts';
import { writeSkel } from '../formats/skel/write.ts';
import { writeSkin } from '../formats/skin/write.ts';
import { writeTrc } from '../formats/trc/write.ts';
import { type Character, isBvh, shownSkin, shownTake } from '../model/document.ts';
import type { FileContent } from '../model/files.ts';
import { lockedDofs, NO_SETS } from '../model/sets.ts';
import { vertexCount } from '../model/skin.ts';
import { formatKindOf, type HeldBy, isSaved, KINDS, SAVED_KINDS, type SavedKind } from './kinds.ts';
import {
  acclaimCopies,
  animCopies,
  axskelCopies,
  bvhCopies,
  type ConversionOptions,
  type Copy,
  markersCopies,
  rigCopies,
  skelCopies,
} from './save/copies.ts';
import { layersCopies } from './save/layers.ts';

/** The functions that saving in a kind of file takes. */
export interface Writer<C> {
  /** Text, or pieces of bytes. Infos name the file. */
  write(content: C, fileName: string): WriteResult | WrittenPieces;
  /** Contents of a character's files, in the save dialog. */
  detail(character: Character, framesPerSecond: number): readonly (string | Counted | PlayedRange)[];
  /** The files of a character whose own parts are no such files (`isOwn`). */
  copies?(character: Character, options: ConversionOptions): readonly Copy[];
  /** Losses of the character in such files, as sentences. */
  lost?(character: Character): readonly string[];
}

/** A number of things, with their name: "1 joint", "2 joints". */
export interface Counted {
  readonly count: number;
  readonly one: string;
  /** Absent: `one` with an s. */
  readonly many?: string;
}

/** The seconds that a file says are played. */
export interface PlayedRange {
  readonly range: readonly [number, number];
}

const joints = ({ skeleton }: Character) => [{ count: skeleton?.joints.length ?? 0, one: 'joint' }];

function framesDetail(character: Character, framesPerSecond: number): readonly (string | Counted)[] {
  const take = shownTake(character);
  const frames = take?.samples?.frameCount;
  if (!take) return ['the pose, 1 frame'];
  return [frames === undefined ? `at ${framesPerSecond} frames per second` : { count: frames, one: 'frame' }];
}

/** What formats of a value per frame leave out. */
function lostAsFrames({ takes, skins }: Character): readonly string[] {
  const isKeyed = takes.some(({ channels }) => channels.some(({ kind }) => kind === 'keys'));
  return [
    ...(isKeyed ? ['Keys and tangents become one value per frame.'] : []),
    ...(skins.length ? ['Skins and their morphs are left out.'] : []),
  ];
}

/** The writer of each kind that can be saved. */
export const WRITERS: { readonly [K in SavedKind]: Writer<HeldBy<K>> } = {
  skel: {
    write: ({ skeletons }, name) => writeSkel(skeletons, name),
    detail: joints,
    copies: skelCopies,
  },
  axskel: {
    write: ({ skeletons }, name) => writeSkel(skeletons, name),
    detail: joints,
    copies: axskelCopies,
    lost: ({ skeleton }) => (skeleton?.joints.some(({ name }) => name) ? ['It stores no joint names.'] : []),
  },
  skin: {
    write: ({ skin }, name) => writeSkin(skin, name),
    detail: (character) => {
      const skin = shownSkin(character);
      return skin ? [{ count: vertexCount(skin), one: 'vertex', many: 'vertices' }] : [];
    },
  },
  morph: {
    write: ({ morph }, name) => writeMorph(morph, name),
    detail: ({ morphs }) => [{ count: morphs.length, one: 'morph' }],
  },
  anim: {
    write: ({ take }, name) => writeAnim(take, name),
    detail: (character) => {
      const take = shownTake(character);
      return take ? [take.name, { count: take.channels.length, one: 'channel' }, { range: take.range }] : [];
    },
    copies: animCopies,
  },
  rig: {
    write: ({ rig }, name) => writeRig(rig, name),
    detail: () => ['which files belong together'],
    copies: rigCopies,
  },
  bvh: {
    write: ({ captures }, name) => writeBvh(captures, name),
    detail: framesDetail,
    copies: bvhCopies,
    lost: (character) => (isBvh(character) ? [] : ['Limits are applied, but not stored.', ...lostAsFrames(character)]),
  },
  asf: {
    write: ({ skeleton }, name) => writeAsf(skeleton, name),
    detail: joints,
    copies: acclaimCopies,
    lost: lostAsFrames,
  },
  amc: {
    write: ({ skeleton, take }, name) => writeAmc({ skeleton, take }, name),
    detail: framesDetail,
    copies: acclaimCopies,
    lost: lostAsFrames,
  },
  trc: {
    write: ({ capture, space }, name) => writeTrc({ capture, ...(space && { space }) }, name),
    detail: (character) => [
      { count: character.skeleton?.joints.length ?? 0, one: 'point' },
      ...framesDetail(character, 0),
    ],
  },
  pose: {
    write: ({ poses }, name) => writePoses(poses, name),
    detail: ({ poses }) => [{ count: poses?.length ?? 0, one: 'pose' }],
  },
  markers: {
    write: ({ markers }, name) => writeMarkers(markers, name),
    detail: ({ takes }) => [
      { count: takes.reduce((sum, { markers }) => sum + (markers?.length ?? 0), 0), one: 'marker' },
    ],
    copies: markersCopies,
  },
  sets: {
    write: ({ sets }, name) => writeSets(sets, name),
    detail: ({ sets = NO_SETS, ...character }) => [
      { count: sets.sets.length, one: 'set' },
      { count: lockedDofs({ ...character, sets }).size, one: 'locked DOF' },
    ],
  },
  layers: {
    write: ({ layers }, name) => writeLayers(layers, name),
    detail: (character) => [{ count: shownTake(character)?.layers?.list.length ?? 0, one: 'layer' }],
    copies: layersCopies,
  },
  limbs: {
    write: ({ limbs }, name) => writeLimbs(limbs, name),
    detail: ({ limbs }) => [{ count: limbs?.list.length ?? 0, one: 'limb' }],
  },
  attach: {
    write: ({ attach }, name) => writeAttach(attach, name),
    detail: (character) => [{ count: shownTake(character)?.attached?.list.length ?? 0, one: 'attachment' }],
    copies: layersCopies,
  },
};

/**
 * Writes content in the format of the file name or else the first one for such content; undefined if there is none, as
 * for images. `fileName` appears in diagnostics.
 */
export function writeFile(content: FileContent, fileName: string): WriteResult | WrittenPieces | undefined {
  const holds = (kind: SavedKind) => KINDS[kind].content === content.kind;
  const named = formatKindOf(fileName);
  const kind = named && isSaved(named) && holds(named) ? named : SAVED_KINDS.find(holds);
  // The kind was chosen for this content; TypeScript can't infer that from the union.
  const writer: Writer<FileContent> | undefined = kind && WRITERS[kind];
  return writer?.write(content, fileName);
}
