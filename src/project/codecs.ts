/**
 * The reader and the writer of each kind of file. The page uses only the writers, fetched when something is saved, and
 * its worker only the readers: the bundler leaves the other table out.
 */
import { animReader } from '../formats/anim/read.ts';
import { writeAnim } from '../formats/anim/write.ts';
import { bvhReader } from '../formats/bvh/read.ts';
import { writeBvh } from '../formats/bvh/write.ts';
import { diagnose } from '../formats/diagnose/diagnose.ts';
import { TEXT_LAYOUTS, type TextLayout } from '../formats/diagnose/layouts.ts';
import { dumpReader } from '../formats/dump/read.ts';
import { morphReader } from '../formats/morph/read.ts';
import { writeMorph } from '../formats/morph/write.ts';
import { poseReader } from '../formats/pose/read.ts';
import { writePoses } from '../formats/pose/write.ts';
import type { Reader, WriteResult, WrittenPieces } from '../formats/reader.ts';
import { rigReader } from '../formats/rig/read.ts';
import { writeRig } from '../formats/rig/write.ts';
import { skelReader } from '../formats/skel/read.ts';
import { writeSkel } from '../formats/skel/write.ts';
import { skinReader } from '../formats/skin/read.ts';
import { writeSkin } from '../formats/skin/write.ts';
import { textureReader } from '../formats/texture/read.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import { type Character, isBvh, shownClip, shownSkin } from '../model/document.ts';
import type { ContentOf, FileContent, FileKind } from '../model/files.ts';
import { vertexCount } from '../model/skin.ts';
import { type FormatKind, formatKindOf, isSaved, KINDS, SAVED_KINDS, type SavedKind } from './kinds.ts';
import {
  animCopies,
  axskelCopies,
  bvhCopies,
  type ConversionOptions,
  type Copy,
  rigCopies,
  skelCopies,
} from './save/copies.ts';

type HeldBy<K extends FormatKind> = ContentOf<(typeof KINDS)[K]['content']>;

/** @param byteLength the file's size, if known; only a hint */
type MakeReader<C> = (fileName: string, byteLength?: number) => Reader<C>;

const skel: MakeReader<ContentOf<'skel'>> = (name) =>
  mapped(skelReader(name), (skeletons) => ({ kind: 'skel', skeletons }));

const READERS: { readonly [K in FormatKind]: MakeReader<HeldBy<K>> } = {
  skel,
  axskel: skel,
  skin: (name) => mapped(skinReader(name), (skin) => ({ kind: 'skin', skin })),
  morph: (name) => mapped(morphReader(name), (morph) => ({ kind: 'morph', morph })),
  anim: (name) => mapped(animReader(name), (clip) => ({ kind: 'anim', clip })),
  rig: (name) => mapped(rigReader(name), (rig) => ({ kind: 'rig', rig })),
  bvh: (name, byteLength) => mapped(bvhReader(name, byteLength), (figures) => ({ kind: 'bvh', figures })),
  pose: (name) => mapped(poseReader(name), (poses) => ({ kind: 'pose', poses })),
  texture: (name) => mapped(textureReader(name), (texture) => ({ kind: 'texture', texture })),
  dump: (name) => mapped(dumpReader(name), (dump) => ({ kind: 'dump', dump })),
};

/** What saving in a kind of file takes. */
export interface Writer<C> {
  /** Text, or pieces of bytes. Infos name the file. */
  write(content: C, fileName: string): WriteResult | WrittenPieces;
  /** What a character's files of it hold, in the save dialog. */
  detail(character: Character, framesPerSecond: number): readonly (string | Counted | PlayedRange)[];
  /** The files of a character whose own parts are no such files (`isOwn`). */
  copies?(character: Character, options: ConversionOptions): readonly Copy[];
  /** What of the character such files can't hold, as sentences. */
  lost?(character: Character): readonly string[];
}

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
    lost: ({ skeleton }) => (skeleton?.joints.some(({ name }) => name) ? ['Joints have no names in it.'] : []),
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
    write: ({ clip }, name) => writeAnim(clip, name),
    detail: (character) => {
      const clip = shownClip(character);
      return clip ? [clip.name, { count: clip.channels.length, one: 'channel' }, { range: clip.range }] : [];
    },
    copies: animCopies,
  },
  rig: {
    write: ({ rig }, name) => writeRig(rig, name),
    detail: () => ['which files belong together'],
    copies: rigCopies,
  },
  bvh: {
    write: ({ figures }, name) => writeBvh(figures, name),
    detail(character, framesPerSecond) {
      const clip = shownClip(character);
      const frames = clip?.samples?.frameCount;
      if (!clip) return ['the pose, 1 frame'];
      return [frames === undefined ? `at ${framesPerSecond} frames per second` : { count: frames, one: 'frame' }];
    },
    copies: bvhCopies,
    lost: (character) => {
      if (isBvh(character)) return [];
      const isKeyed = character.clips.some(({ channels }) => channels.some(({ kind }) => kind === 'keys'));
      return [
        'Limits are applied, but not kept.',
        ...(isKeyed ? ['Keys and tangents become one value per frame.'] : []),
        ...(character.skins.length ? ['Skins and their morphs are left out.'] : []),
      ];
    },
  },
  pose: {
    write: ({ poses }, name) => writePoses(poses, name),
    detail: ({ poses }) => [{ count: poses?.length ?? 0, one: 'pose' }],
  },
};

export interface Format {
  readonly format: FormatKind;
  /** The content of such a file. */
  readonly kind: FileKind;
  readonly label: string;
  readonly reader: MakeReader<FileContent>;
  /**
   * The problems that a reading told, each where it really is, and without what follows from others; from the bytes of
   * the whole file. Absent if it is no text.
   */
  readonly diagnose?: (fileName: string, bytes: Uint8Array, told: readonly Diagnostic[]) => readonly Diagnostic[];
}

/** The format of a file by its extension, in any case; undefined for other files. */
export function formatOf(fileName: string): Format | undefined {
  const format = formatKindOf(fileName);
  if (!format) return undefined;
  const reader: MakeReader<FileContent> = READERS[format];
  const layouts: { readonly [K in FormatKind]?: TextLayout } = TEXT_LAYOUTS;
  const layout = layouts[format];
  return {
    format,
    kind: KINDS[format].content,
    label: KINDS[format].label,
    reader,
    ...(layout && {
      diagnose: (name: string, bytes: Uint8Array, told: readonly Diagnostic[]) =>
        diagnose(bytes, told, layout, () => reader(name, bytes.length)),
    }),
  };
}

/**
 * For files whose names say nothing: a dump is told by content. A function, since the bundler keeps a table that is read
 * at the top level of a module, and so all readers in the page.
 */
export function dumpFormat(): Format {
  return { format: 'dump', kind: 'dump', label: KINDS.dump.label, reader: READERS.dump };
}

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

function mapped<A, B>(reader: Reader<A>, map: (value: A) => B): Reader<B> {
  return {
    feed: (chunk) => reader.feed(chunk),
    end: () => {
      const { value, diagnostics } = reader.end();
      return value === undefined ? { diagnostics } : { value: map(value), diagnostics };
    },
  };
}
