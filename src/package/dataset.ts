/**
 * `marrow/dataset`: takes as arrays of numbers, and files of them for numpy and others.
 *
 *     const arrays = takeArrays(character, { fps: 30 });
 *     await writeFile('walk.npz', writeNpz(arrays));
 */
import { csvPieces } from '../dataset/csv.ts';
import { FloatPool, type Precision } from '../dataset/float-pool.ts';
import { jsonPieces } from '../dataset/json.ts';
import { npzPieces } from '../dataset/npz.ts';
import { parquetPieces } from '../dataset/parquet.ts';
import { besideTable, tableColumns } from '../dataset/table.ts';
import { type TakeOptions, takeOf } from '../dataset/take.ts';
import { takeArrays as arraysOf, namedArrays, type TakeArrays } from '../dataset/take-arrays.ts';
import { provideLayers } from '../evaluate/layers.ts';
import { crc32 } from '../formats/png/crc32.ts';
import type { Character } from '../model/document.ts';
import { joined } from './joined.ts';

export type { Precision } from '../dataset/float-pool.ts';
export type { JointMap } from '../dataset/joint-map.ts';
export type { Crop, RetargetTarget, TakeOptions } from '../dataset/take.ts';
export type { TakeArrays } from '../dataset/take-arrays.ts';
export type { Character } from '../model/document.ts';

provideLayers();

/** Options of `takeArrays`. */
export interface ArrayOptions extends TakeOptions {
  /** Default `float32`. */
  readonly precision?: Precision;
}

/** Facts about a file that are written into it: anything that JSON can say. */
export type Meta = Readonly<Record<string, unknown>>;

/**
 * The frames of a character's shown take as arrays: positions, rotations, velocities and foot contacts, in metres, y up,
 * unless `isRaw`.
 * @throws UserError if it has no skeleton or no motion, or nothing is left after cropping
 */
export function takeArrays(character: Character, { precision = 'float32', ...options }: ArrayOptions = {}): TakeArrays {
  return arraysOf(takeOf(character, options), new FloatPool(precision));
}

/** Writes arrays as numpy's `.npz`: `np.load` gives them by the names in the manual. @param meta as a text, JSON */
export function writeNpz(arrays: TakeArrays, meta: Meta = {}): Uint8Array<ArrayBuffer> {
  const told = { name: 'meta', type: 'text', shape: [], data: [JSON.stringify(meta)] } as const;
  return joined(npzPieces([...namedArrays(arrays), told], crc32));
}

/** Writes arrays as Parquet, one row per frame; the skeleton and `meta` are in its metadata, under `marrow`. */
export function writeParquet(arrays: TakeArrays, meta: Meta = {}): Uint8Array<ArrayBuffer> {
  const marrow = JSON.stringify({ ...meta, ...besideTable(arrays) });
  return joined(parquetPieces(tableColumns(arrays), arrays.frameCount, { marrow }));
}

/** Writes arrays as CSV, one row per frame. */
export function writeCsv(arrays: TakeArrays): string {
  return [...csvPieces(arrays)].join('');
}

/** Writes arrays as JSON. @param meta as the last member */
export function writeJson(arrays: TakeArrays, meta: Meta = {}): string {
  return [...jsonPieces(namedArrays(arrays), meta)].join('');
}
