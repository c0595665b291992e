/**
 * The one list of text formats: what worker and command read. Another format is another entry,
 * and a case in `write.ts`.
 */
import type { FileContent, FileKind } from '../model/files.ts';
import { animReader } from './anim/read.ts';
import { bvhReader } from './bvh/read.ts';
import { morphReader } from './morph/read.ts';
import { poseReader } from './pose/read.ts';
import type { Reader } from './reader.ts';
import { rigReader } from './rig/read.ts';
import { skelReader } from './skel/read.ts';
import { skinReader } from './skin/read.ts';

export interface Format {
  /** What a file of it holds. */
  readonly kind: FileKind;
  /** Without the dot, lower case; the first one is written. */
  readonly extensions: readonly string[];
  /** As a person would say it: "skeleton". */
  readonly label: string;
  /** `byteLength`: the file's, where it is known; only a hint. */
  reader(fileName: string, byteLength?: number): Reader<FileContent>;
}

export const FORMATS: readonly Format[] = [
  {
    kind: 'skel',
    // The axis-angle form is told by what is in a file, and may be called either.
    extensions: ['skel', 'axskel'],
    label: 'skeleton',
    reader: (name) => mapped(skelReader(name), (skeletons) => ({ kind: 'skel', skeletons })),
  },
  {
    kind: 'skin',
    extensions: ['skin'],
    label: 'skin',
    reader: (name) => mapped(skinReader(name), (skin) => ({ kind: 'skin', skin })),
  },
  {
    kind: 'morph',
    extensions: ['morph'],
    label: 'morph',
    reader: (name) => mapped(morphReader(name), (morph) => ({ kind: 'morph', morph })),
  },
  {
    kind: 'anim',
    extensions: ['anim'],
    label: 'animation',
    reader: (name) => mapped(animReader(name), (clip) => ({ kind: 'anim', clip })),
  },
  {
    kind: 'rig',
    extensions: ['rig'],
    label: 'rig',
    reader: (name) => mapped(rigReader(name), (rig) => ({ kind: 'rig', rig })),
  },
  {
    kind: 'bvh',
    extensions: ['bvh'],
    label: 'motion capture',
    reader: (name, byteLength) => mapped(bvhReader(name, byteLength), (figures) => ({ kind: 'bvh', figures })),
  },
  {
    kind: 'pose',
    extensions: ['pose'],
    label: 'poses',
    reader: (name) => mapped(poseReader(name), (poses) => ({ kind: 'pose', poses })),
  },
];

/** Without dots. */
export const READABLE_EXTENSIONS: readonly string[] = FORMATS.flatMap(({ extensions }) => extensions);

/** The format that a file's name tells, in any case; undefined for a file of another kind. */
export function formatOf(fileName: string): Format | undefined {
  const dot = fileName.lastIndexOf('.');
  const extension = dot < 0 ? '' : fileName.slice(dot + 1).toLowerCase();
  return FORMATS.find(({ extensions }) => extensions.includes(extension));
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
