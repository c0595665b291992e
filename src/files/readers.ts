/** The reader of each kind of file. Only the worker and the command need them; writers are in `writers.ts`. */

import { animReader } from '../formats/anim/read.ts';
import { attachReader } from '../formats/attach/read.ts';
import { bvhReader } from '../formats/bvh/read.ts';
import { diagnose } from '../formats/diagnose/diagnose.ts';
import { TEXT_LAYOUTS, type TextLayout } from '../formats/diagnose/layouts.ts';
import { dumpReader } from '../formats/dump/read.ts';
import { layersReader } from '../formats/layers/read.ts';
import { limbsReader } from '../formats/limbs/read.ts';
import { markersReader } from '../formats/markers/read.ts';
import { morphReader } from '../formats/morph/read.ts';
import { NO_PLACE } from '../formats/places.ts';
import { poseReader } from '../formats/pose/read.ts';
import { bytesReader, type Reader, readerByHead } from '../formats/reader.ts';
import { rigReader } from '../formats/rig/read.ts';
import { setsReader } from '../formats/sets/read.ts';
import { skelReader } from '../formats/skel/read.ts';
import { skinReader } from '../formats/skin/read.ts';
import { textureReader } from '../formats/texture/read.ts';
import type { Import } from '../import/imported.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import type { ContentOf, FileContent, FileKind } from '../model/files.ts';
import { capturedContent } from './captured.ts';
import { HEAD_BYTES, otherContent } from './foreign.ts';
import type { ImportedFile } from './imports.ts';
import { type FormatKind, formatKindOf, type HeldBy, KINDS } from './kinds.ts';

/** @param byteLength the file's size, if known; only a hint */
type MakeReader<C> = (fileName: string, byteLength?: number) => Reader<C>;

const skel: MakeReader<ContentOf<'skel'>> = (name) =>
  mapped(skelReader(name), (skeletons) => ({ kind: 'skel', skeletons }));

const dump: MakeReader<ContentOf<'dump'>> = (name) =>
  mapped(dumpReader(name), (found) => ({ kind: 'dump', dump: found }));

/** Reads a file whole, with others beside it or with decoders: fetched when a file needs it, since few do. */
interface Fetched<C> {
  readonly imports: (given: Import) => Promise<ImportedFile<C>>;
  /** Reads those that `imports` says are other files. */
  readonly others?: MakeReader<ContentOf<'dump'>>;
}

const READERS = {
  skel,
  axskel: skel,
  skin: (name) => mapped(skinReader(name), (skin) => ({ kind: 'skin', skin })),
  morph: (name) => mapped(morphReader(name), (morph) => ({ kind: 'morph', morph })),
  anim: (name) => mapped(animReader(name), (take) => ({ kind: 'anim', take })),
  rig: (name) => mapped(rigReader(name), (rig) => ({ kind: 'rig', rig })),
  bvh: captured,
  pose: (name) => mapped(poseReader(name), (poses) => ({ kind: 'pose', poses })),
  gltf: { imports: async (given: Import) => (await import('./imports.ts')).importFile('gltf', given) },
  fbx: { imports: async (given: Import) => (await import('./imports.ts')).importFile('fbx', given) },
  asf: { imports: async (given: Import) => (await import('./acclaim.ts')).readAcclaimSkeleton(given) },
  amc: { imports: async (given: Import) => (await import('./acclaim.ts')).readAcclaimTake(given) },
  numpy: { imports: async (given: Import) => (await import('./numpy.ts')).readNumpyFile(given) },
  c3d: { imports: async (given: Import) => (await import('./points.ts')).readPointsFile('c3d', given) },
  trc: { imports: async (given: Import) => (await import('./points.ts')).readTrcFile(given) },
  table: { imports: async (given: Import) => (await import('./points.ts')).readTable(given), others: dump },
  texture: (name) => mapped(textureReader(name), (texture) => ({ kind: 'texture', texture })),
  markers: (name) => mapped(markersReader(name), (markers) => ({ kind: 'markers', markers })),
  sets: (name) => mapped(setsReader(name), (sets) => ({ kind: 'sets', sets })),
  layers: (name) => mapped(layersReader(name), (layers) => ({ kind: 'layers', layers })),
  limbs: (name) => mapped(limbsReader(name), (limbs) => ({ kind: 'limbs', limbs })),
  attach: (name) => mapped(attachReader(name), (attach) => ({ kind: 'attach', attach })),
  dump,
} satisfies { readonly [K in FormatKind]: MakeReader<HeldBy<K>> | Fetched<HeldBy<K> | ContentOf<'character'>> };

/** A kind of file that is read whole, by a reader that is fetched for it. */
export type FetchedKind = {
  [K in FormatKind]: (typeof READERS)[K] extends Fetched<unknown> ? K : never;
}[FormatKind];

/** How files of one format are read. */
export interface Format {
  readonly format: FormatKind;
  /** The content of such a file. */
  readonly kind: FileKind;
  readonly label: string;
  readonly reader: MakeReader<FileContent>;
  /** Reads such files instead of `reader`, which can't: they need other files, or decoders that are fetched. */
  readonly imports?: (given: Import) => Promise<ImportedFile>;
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
  const reader = readerOf(format);
  const own: MakeReader<FileContent> | Fetched<FileContent> = READERS[format];
  const layouts: { readonly [K in FormatKind]?: TextLayout } = TEXT_LAYOUTS;
  const layout = layouts[format];
  return {
    format,
    kind: KINDS[format].content,
    label: KINDS[format].label,
    reader,
    ...('imports' in own && {
      imports: async (given: Import) => {
        const other = otherContent(given.fileName, format, given.bytes);
        return other ? { diagnostics: [other], beside: [] } : own.imports(given);
      },
    }),
    ...(layout && {
      diagnose: (name: string, bytes: Uint8Array, told: readonly Diagnostic[]) =>
        otherContent(name, format, bytes) ? told : diagnose(bytes, told, layout, () => reader(name, bytes.length)),
    }),
  };
}

/**
 * For files whose names say nothing: a dump is told by content. A function, since the bundler keeps a table that is
 * read at the top level of a module, and so all readers in the page.
 */
export function dumpFormat(): Format {
  return { format: 'dump', kind: 'dump', label: KINDS.dump.label, reader: readerOf('dump') };
}

/** Whatever the name of a file says, its first bytes may be those of something else. */
function readerOf(format: FormatKind): MakeReader<FileContent> {
  const own: MakeReader<FileContent> | Fetched<FileContent> = READERS[format];
  const reader = 'imports' in own ? (own.others ?? notStreamed) : own;
  return (name, byteLength) =>
    readerByHead(HEAD_BYTES, (head) => {
      const other = otherContent(name, format, head);
      return other ? { feed: () => undefined, end: () => ({ diagnostics: [other] }) } : reader(name, byteLength);
    });
}

/** For files that `imports` reads. */
function notStreamed(name: string): Reader<never> {
  return bytesReader<never>(name, (_, report) => {
    report.error(
      'import-needed',
      'Files from other programs are not read here. Convert it to Marrow’s own formats first.',
      NO_PLACE,
    );
    return undefined;
  });
}

function captured(name: string, byteLength?: number): Reader<ContentOf<'bvh'>> {
  const reader = bvhReader(name, byteLength);
  return {
    feed: (chunk) => reader.feed(chunk),
    end: () => {
      const { value, diagnostics } = reader.end();
      if (value === undefined) return { diagnostics };
      const content = capturedContent(value, name);
      return { value: content.value, diagnostics: [...diagnostics, ...content.diagnostics] };
    },
  };
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
