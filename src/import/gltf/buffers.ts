/** Buffers and the views into them: where the numbers of a glTF file are. */
import type { SourceFile } from '../../model/files.ts';
import { Budget } from '../budget.ts';
import { counted, type Import, ImportError } from '../imported.ts';
import type { Container } from './container.ts';
import { readDataUri, unescaped } from './data-uri.ts';
import { countOf, type Document, extensionOf, type Json, shown, textOf } from './json.ts';
import type { MeshoptDecoder } from './meshopt.ts';

/** Both names are in use: the ratified one came later. */
export const MESHOPT = ['EXT_meshopt_compression', 'KHR_meshopt_compression'] as const;

/** A range of bytes. */
export interface View {
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** From one element to the next; absent: they are packed. */
  readonly stride?: number;
}

/** The bytes of a file's buffers, and views into them, unpacked where they are compressed. */
export class Buffers {
  private readonly views = new Map<number, View>();

  private constructor(
    private readonly document: Document,
    private readonly buffers: ReadonlyMap<number, Uint8Array<ArrayBuffer>>,
    private readonly decoder: MeshoptDecoder | undefined,
    /** Files that were used. */
    readonly sources: readonly SourceFile[],
    /** Budget of all that is read from them. */
    readonly budget: Budget,
  ) {}

  /** Fetches what the buffers name. A buffer without bytes is an error only where it is used. */
  static async load({ document, binary }: Container, given: Import, meshopt: MeshoptDecoder | undefined) {
    const buffers = new Map<number, Uint8Array<ArrayBuffer>>();
    const sources: SourceFile[] = [];
    const missing: string[] = [];
    // Buffers may name the same file.
    const known = new Map<unknown, Uint8Array<ArrayBuffer> | undefined>();
    let size = given.bytes.length;
    for (const [index, buffer] of document.all('buffers').entries()) {
      const isKnown = known.has(buffer.uri) && buffer.uri !== undefined;
      const bytes = isKnown ? known.get(buffer.uri) : await bytesOf(buffer, index, binary, given, sources, missing);
      if (!isKnown && buffer.uri !== undefined) {
        known.set(buffer.uri, bytes);
        size += bytes?.length ?? 0;
      }
      if (!bytes) continue;
      const stated = countOf(buffer.byteLength);
      // The chunk of a GLB is padded.
      if (stated !== undefined && stated < bytes.length) buffers.set(index, bytes.subarray(0, stated));
      else buffers.set(index, bytes);
    }
    if (missing.length) throw notGiven(missing);
    const budget = new Budget(size, (message) => {
      throw new ImportError('file-too-large', message);
    });
    return new Buffers(document, buffers, meshopt, sources, budget);
  }

  /**
   * The bytes of a buffer view; decompressed if they are compressed.
   * @throws ImportError if it reaches past its buffer
   */
  view(index: unknown, where: string): View {
    const known = this.views.get(Number(index));
    if (known) return known;
    const json = this.document.at('bufferViews', index, where);
    const packed = MESHOPT.map((name) => extensionOf(json, name)).find((e) => e !== undefined);
    const view = packed ? this.unpacked(packed, Number(index)) : this.range(json, Number(index));
    this.views.set(Number(index), view);
    return view;
  }

  private range(json: Json, index: number): View {
    const buffer = this.buffers.get(Number(json.buffer));
    if (!buffer) {
      throw new ImportError(
        'buffer-missing',
        `bufferView ${index} is in buffer ${shown(json.buffer)}, which has no bytes.`,
      );
    }
    const offset = countOf(json.byteOffset) ?? 0;
    const length = countOf(json.byteLength);
    if (length === undefined) {
      const message = `Expected the length of bufferView ${index} in bytes, found ${shown(json.byteLength)}. The file may be damaged: export it again.`;
      throw new ImportError('view-without-length', message);
    }
    if (offset + length > buffer.length) {
      const message = `bufferView ${index} reaches to byte ${offset + length} of buffer ${shown(json.buffer)}, which has ${counted(buffer.length, 'byte')}. The file may have been cut off: copy or export it again.`;
      throw new ImportError('buffer-too-short', message);
    }
    const stride = countOf(json.byteStride);
    return { bytes: buffer.subarray(offset, offset + length), ...(stride && { stride }) };
  }

  private unpacked(packed: Json, index: number): View {
    const { bytes } = this.range(packed, index);
    const count = countOf(packed.count) ?? 0;
    const stride = countOf(packed.byteStride) ?? 0;
    this.budget.spend((count * stride) / 8, `bufferView ${index}`);
    if (!this.decoder) throw new Error('The decoder is loaded for files that have such views.');
    const mode = textOf(packed.mode) ?? '';
    const filter = textOf(packed.filter) ?? 'NONE';
    return { bytes: this.decoder.decode(count, stride, bytes, mode, filter, `bufferView ${index}`), stride };
  }
}

async function bytesOf(
  buffer: Json,
  index: number,
  binary: Uint8Array<ArrayBuffer> | undefined,
  given: Import,
  sources: SourceFile[],
  missing: string[],
): Promise<Uint8Array<ArrayBuffer> | undefined> {
  const uri = textOf(buffer.uri);
  if (uri === undefined) return index === 0 ? binary : undefined;
  const inside = readDataUri(uri);
  if (inside) return inside.bytes;
  const found = await given.beside(unescaped(uri));
  if (found) {
    sources.push(found.source);
    return found.bytes;
  }
  missing.push(uri);
  return undefined;
}

function notGiven(uris: readonly string[]): ImportError {
  const names = uris.slice(0, MAX_NAMED).map((uri) => `"${shortened(uri)}"`);
  const more = uris.length - names.length;
  const parts = `${names.join(', ')}${more > 0 ? ` and ${more} more` : ''}`;
  const [was, it] = uris.length === 1 ? ['was', 'it'] : ['were', 'them'];
  const message = `The file needs ${parts} for its ${uris.length === 1 ? 'buffer' : 'buffers'}, which ${was} not given. Add ${it}, or open the folder with all of its files.`;
  return new ImportError('part-not-given', message);
}

const MAX_NAMED = 4;

/** A URI, shortened for messages. */
function shortened(uri: string): string {
  return uri.length > 80 ? `${uri.slice(0, 77)}…` : uri;
}
