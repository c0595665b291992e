/** The formats of exported takes. */
import { crc32 } from 'node:zlib';
import { npzPieces } from '../../dataset/npz.ts';
import { namedArrays, type TakeArrays } from '../../dataset/take-arrays.ts';

/** What was done to get the arrays: names as in JSON. */
export type Meta = Readonly<Record<string, unknown>>;

/** A file to be written, in pieces. */
export interface ExportedFile {
  readonly ending: string;
  readonly pieces: Iterable<string | Uint8Array>;
}

export interface ExportWriter {
  /** The files of a take; the first is its output, and the others are beside it. */
  write(arrays: TakeArrays, meta: Meta): readonly ExportedFile[] | Promise<readonly ExportedFile[]>;
}

export const FORMATS = {
  npz: {
    write(arrays, meta) {
      const all = [
        ...namedArrays(arrays),
        { name: 'meta', type: 'text', shape: [], data: [JSON.stringify(meta)] } as const,
      ];
      return [{ ending: 'npz', pieces: npzPieces(all, crc32) }];
    },
  },
} as const satisfies Readonly<Record<string, ExportWriter>>;

export type ExportFormat = keyof typeof FORMATS;
