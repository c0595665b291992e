/**
 * Writes Parquet: a table by columns, of which none may be empty cells. One row group; each column is one page of
 * plain, uncompressed values, so that the same table gives the same bytes, and the metadata say where it starts.
 *
 *     PAR1    page header, values; of each column    metadata, their length    PAR1
 *
 * `hyparquet-writer` can do more: nested and empty values, encodings, compression, of which none is of use for motion,
 * whose numbers hardly repeat. The same table it writes in fifteen times the time, from copies of
 * all columns at once.
 */

import type { TableColumn } from './table.ts';
import { type ThriftFields, type ThriftValue, thriftBytes } from './thrift.ts';

const MAGIC = Uint8Array.of(0x50, 0x41, 0x52, 0x31);

/** Parquet's numbers for types, encodings, and others. */
const BOOLEAN = 0;
const FLOAT = 4;
const DOUBLE = 5;
const REQUIRED = 0;
const PLAIN = 0;
const RLE = 3;
const UNCOMPRESSED = 0;
const DATA_PAGE = 0;

/**
 * Writes a table as Parquet, in pieces to be written one after the other.
 * @param metadata texts by their names
 */
export function* parquetPieces(
  columns: readonly TableColumn[],
  rowCount: number,
  metadata: Readonly<Record<string, string>>,
): Generator<Uint8Array> {
  yield MAGIC;
  let at = MAGIC.length;
  const chunks: ThriftValue[] = [];
  for (const column of columns) {
    const values = plainValues(column, rowCount);
    const header = thriftBytes(pageHeader(values.length, rowCount));
    const size = header.length + values.length;
    chunks.push({ struct: columnChunk(column, rowCount, at, size) });
    yield header;
    yield values;
    at += size;
  }
  const footer = thriftBytes([
    [1, { i32: 1 }],
    [
      2,
      {
        list: [
          {
            struct: [
              [4, { text: 'take' }],
              [5, { i32: columns.length }],
            ],
          },
          ...columns.map(schemaOf),
        ],
      },
    ],
    [3, { i64: rowCount }],
    [
      4,
      {
        list: [
          {
            struct: [
              [1, { list: chunks }],
              [2, { i64: at - MAGIC.length }],
              [3, { i64: rowCount }],
            ],
          },
        ],
      },
    ],
    [
      5,
      {
        list: Object.entries(metadata).map(([key, text]) => ({
          struct: [
            [1, { text: key }],
            [2, { text }],
          ],
        })),
      },
    ],
    [6, { text: 'marrow' }],
  ]);
  yield footer;
  const length = footer.length;
  yield Uint8Array.of(length & 0xff, (length >> 8) & 0xff, (length >> 16) & 0xff, length >>> 24);
  yield MAGIC;
}

function typeOf({ data }: TableColumn): number {
  if (data instanceof Uint8Array) return BOOLEAN;
  return data instanceof Float64Array ? DOUBLE : FLOAT;
}

function schemaOf(column: TableColumn): ThriftValue {
  return {
    struct: [
      [1, { i32: typeOf(column) }],
      [3, { i32: REQUIRED }],
      [4, { text: column.name }],
    ],
  };
}

function pageHeader(bytes: number, rowCount: number): ThriftFields {
  const data: ThriftFields = [
    [1, { i32: rowCount }],
    [2, { i32: PLAIN }],
    [3, { i32: RLE }],
    [4, { i32: RLE }],
  ];
  return [
    [1, { i32: DATA_PAGE }],
    [2, { i32: bytes }],
    [3, { i32: bytes }],
    [5, { struct: data }],
  ];
}

function columnChunk(column: TableColumn, rowCount: number, at: number, size: number): ThriftFields {
  const meta: ThriftFields = [
    [1, { i32: typeOf(column) }],
    [2, { list: [{ i32: PLAIN }] }],
    [3, { list: [{ text: column.name }] }],
    [4, { i32: UNCOMPRESSED }],
    [5, { i64: rowCount }],
    [6, { i64: size }],
    [7, { i64: size }],
    [9, { i64: at }],
  ];
  return [
    [2, { i64: at }],
    [3, { struct: meta }],
  ];
}

/** Little-endian numbers; of booleans eight a byte, the first in the lowest bit. */
function plainValues({ data, first, step }: TableColumn, rowCount: number): Uint8Array {
  if (data instanceof Uint8Array) {
    const bits = new Uint8Array(Math.ceil(rowCount / 8));
    for (let r = 0; r < rowCount; r++) bits[r >> 3] |= data[first + r * step] << (r & 7);
    return bits;
  }
  const values = data instanceof Float64Array ? new Float64Array(rowCount) : new Float32Array(rowCount);
  for (let r = 0; r < rowCount; r++) values[r] = data[first + r * step];
  return new Uint8Array(values.buffer);
}
