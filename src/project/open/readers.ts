/** The reader of each kind of text file, for the worker and the command. */
import { animReader } from '../../formats/anim/read.ts';
import { bvhReader } from '../../formats/bvh/read.ts';
import { morphReader } from '../../formats/morph/read.ts';
import { poseReader } from '../../formats/pose/read.ts';
import type { Reader } from '../../formats/reader.ts';
import { rigReader } from '../../formats/rig/read.ts';
import { skelReader } from '../../formats/skel/read.ts';
import { skinReader } from '../../formats/skin/read.ts';
import type { FileContent, FileKind } from '../../model/files.ts';
import { type FormatKind, formatKindOf, KINDS } from '../kinds.ts';

/** @param byteLength the file's size, if known; only a hint */
type MakeReader = (fileName: string, byteLength?: number) => Reader<FileContent>;

const skel: MakeReader = (name) => mapped(skelReader(name), (skeletons) => ({ kind: 'skel', skeletons }));

export const READERS: Readonly<Record<FormatKind, MakeReader>> = {
  skel,
  axskel: skel,
  skin: (name) => mapped(skinReader(name), (skin) => ({ kind: 'skin', skin })),
  morph: (name) => mapped(morphReader(name), (morph) => ({ kind: 'morph', morph })),
  anim: (name) => mapped(animReader(name), (clip) => ({ kind: 'anim', clip })),
  rig: (name) => mapped(rigReader(name), (rig) => ({ kind: 'rig', rig })),
  bvh: (name, byteLength) => mapped(bvhReader(name, byteLength), (figures) => ({ kind: 'bvh', figures })),
  pose: (name) => mapped(poseReader(name), (poses) => ({ kind: 'pose', poses })),
};

export interface Format {
  /** The content of such a file. */
  readonly kind: FileKind;
  readonly label: string;
  readonly reader: MakeReader;
}

/** The format of a file by its extension, in any case; undefined for other files. */
export function formatOf(fileName: string): Format | undefined {
  const kind = formatKindOf(fileName);
  return kind && { kind: KINDS[kind].content, label: KINDS[kind].label, reader: READERS[kind] };
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
