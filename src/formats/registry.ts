/**
 * The one list of text formats: what worker, page and command read and write. Another format is another entry.
 */
import type { FileContent, FileKind } from '../model/files.ts';
import { animReader } from './anim/read.ts';
import { writeAnim } from './anim/write.ts';
import { morphReader } from './morph/read.ts';
import { writeMorph } from './morph/write.ts';
import type { Reader, WriteResult } from './reader.ts';
import { rigReader } from './rig/read.ts';
import { writeRig } from './rig/write.ts';
import { skelReader } from './skel/read.ts';
import { writeSkel } from './skel/write.ts';
import { skinReader } from './skin/read.ts';
import { writeSkin } from './skin/write.ts';

export interface Format {
  /** What a file of it holds. */
  readonly kind: FileKind;
  /** Without the dot, lower case; the first one is written. */
  readonly extensions: readonly string[];
  /** As a person would say it: "skeleton". */
  readonly label: string;
  reader(fileName: string): Reader<FileContent>;
  /** Undefined for content of another kind. `fileName` is what infos name. */
  write(content: FileContent, fileName: string): WriteResult | undefined;
}

export const FORMATS: readonly Format[] = [
  {
    kind: 'skel',
    extensions: ['skel'],
    label: 'skeleton',
    reader: (name) => mapped(skelReader(name), (skeletons) => ({ kind: 'skel', skeletons })),
    write: (content, name) => (content.kind === 'skel' ? writeSkel(content.skeletons, name) : undefined),
  },
  {
    kind: 'skin',
    extensions: ['skin'],
    label: 'skin',
    reader: (name) => mapped(skinReader(name), (skin) => ({ kind: 'skin', skin })),
    write: (content, name) => (content.kind === 'skin' ? writeSkin(content.skin, name) : undefined),
  },
  {
    kind: 'morph',
    extensions: ['morph'],
    label: 'morph',
    reader: (name) => mapped(morphReader(name), (morph) => ({ kind: 'morph', morph })),
    write: (content, name) => (content.kind === 'morph' ? writeMorph(content.morph, name) : undefined),
  },
  {
    kind: 'anim',
    extensions: ['anim'],
    label: 'animation',
    reader: (name) => mapped(animReader(name), (clip) => ({ kind: 'anim', clip })),
    write: (content, name) => (content.kind === 'anim' ? writeAnim(content.clip, name) : undefined),
  },
  {
    kind: 'rig',
    extensions: ['rig'],
    label: 'rig',
    reader: (name) => mapped(rigReader(name), (rig) => ({ kind: 'rig', rig })),
    write: (content, name) => (content.kind === 'rig' ? writeRig(content.rig, name) : undefined),
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
