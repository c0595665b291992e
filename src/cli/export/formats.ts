/** The formats of exported takes. */
import { crc32 } from 'node:zlib';
import { csvPieces } from '../../dataset/csv.ts';
import { jsonPieces } from '../../dataset/json.ts';
import { npzPieces } from '../../dataset/npz.ts';
import { parquetPieces } from '../../dataset/parquet.ts';
import { besideTable, tableColumns } from '../../dataset/table.ts';
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
  write(arrays: TakeArrays, meta: Meta): readonly ExportedFile[];
}

export const FORMATS = {
  npz: {
    write(arrays, meta) {
      const said = { name: 'meta', type: 'text', shape: [], data: [JSON.stringify(meta)] } as const;
      return [{ ending: 'npz', pieces: npzPieces([...namedArrays(arrays), said], crc32) }];
    },
  },
  parquet: {
    write(arrays, meta) {
      const marrow = JSON.stringify({ ...meta, ...besideTable(arrays) });
      return [{ ending: 'parquet', pieces: parquetPieces(tableColumns(arrays), arrays.frameCount, { marrow }) }];
    },
  },
  csv: {
    write(arrays, meta) {
      const beside = `${JSON.stringify({ ...meta, ...besideTable(arrays) }, null, 1)}\n`;
      return [
        { ending: 'csv', pieces: csvPieces(arrays) },
        { ending: 'json', pieces: [beside] },
      ];
    },
  },
  json: {
    write: (arrays, meta) => [{ ending: 'json', pieces: jsonPieces(namedArrays(arrays), meta) }],
  },
} as const satisfies Readonly<Record<string, ExportWriter>>;

export type ExportFormat = keyof typeof FORMATS;

// The type of an object's keys is not that of its own ones, which these are.
export const FORMAT_NAMES = Object.keys(FORMATS) as readonly ExportFormat[];
