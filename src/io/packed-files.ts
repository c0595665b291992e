/**
 * Read files as a short text, without a reader: the opening example comes so from the build. Numbers are those that
 * were read, to the last bit.
 *
 *     {"column":"Uint32Array","values":[0,1,2,3,3,3],"back":3}      0 1 2 3 4 5: each less the one three before it
 */
import type { ParsedFile } from '../model/files.ts';

const COLUMNS = { Float64Array, Uint32Array, Uint8Array } as const;
type ColumnName = keyof typeof COLUMNS;
type Column = InstanceType<(typeof COLUMNS)[ColumnName]>;

interface PackedColumn {
  readonly column: ColumnName;
  /** Base64 of bytes that are no numbers. */
  readonly values: readonly number[] | string;
  /** Whole numbers are divided by this: decimals have exact ones. */
  readonly per?: number;
  /** How far before it the number is that each is told from. */
  readonly back?: number;
}

/** Numbers resemble the one before, or the same component of the vector before. */
const BACK = [1, 3];
const MAX_DECIMALS = 9;
/** Longer ones are the bytes of a picture. */
const MAX_BYTE_NUMBERS = 1000;

/**
 * @param sizeOf of the alternatives for a column the shortest is taken, by this
 * @throws for other columns
 */
export function packFiles(files: readonly ParsedFile[], sizeOf: (text: string) => number): string {
  return JSON.stringify(files, (_key, value: unknown) => (ArrayBuffer.isView(value) ? packed(value, sizeOf) : value));
}

/** Inverse of `packFiles`, of its JSON. */
export function unpackFiles(json: unknown): readonly ParsedFile[] {
  // Written by `packFiles` of the same build.
  return unpacked(json) as readonly ParsedFile[];
}

function packed(value: ArrayBufferView, sizeOf: (text: string) => number): PackedColumn {
  const column = (Object.keys(COLUMNS) as ColumnName[]).find((name) => value instanceof COLUMNS[name]);
  if (column === undefined) throw new Error(`A ${value.constructor.name} can't be packed.`);
  // Of one of these types, by its name.
  const numbers = value as Column;
  if (numbers instanceof Uint8Array && numbers.length > MAX_BYTE_NUMBERS) {
    return { column, values: btoa(Array.from(numbers, (byte) => String.fromCharCode(byte)).join('')) };
  }
  const plain: PackedColumn = { column, values: Array.from(numbers) };
  const per = scaleOf(numbers);
  const whole = per === undefined ? [] : Array.from(numbers, (number) => Math.round(number * per));
  const others = BACK.map((back): PackedColumn => {
    const values = whole.map((number, i) => number - (i < back ? 0 : whole[i - back]));
    return { column, values, back, ...(per !== undefined && per > 1 && { per }) };
  });
  const sizes = [plain, ...(per === undefined ? [] : others)].map((one) => ({
    one,
    size: sizeOf(JSON.stringify(one)),
  }));
  return sizes.reduce((least, next) => (next.size < least.size ? next : least)).one;
}

/** The power of ten by which all are whole numbers; undefined if there is none, or one is −0. */
function scaleOf(numbers: Column): number | undefined {
  for (let per = 1; per <= 10 ** MAX_DECIMALS; per *= 10) {
    if (numbers.every((number) => Object.is(Math.round(number * per) / per, number))) return per;
  }
  return undefined;
}

function unpacked(value: unknown): unknown {
  if (typeof value !== 'object' || value === null) return value;
  if (isColumn(value)) return columnOf(value);
  if (Array.isArray(value)) return value.map(unpacked);
  return Object.fromEntries(Object.entries(value).map(([key, one]) => [key, unpacked(one)]));
}

function isColumn(value: object): value is PackedColumn {
  return 'column' in value;
}

function columnOf({ column, values, per = 1, back = 0 }: PackedColumn): Column {
  if (typeof values === 'string') return Uint8Array.from(atob(values), (letter) => letter.charCodeAt(0));
  const out = new COLUMNS[column](values);
  if (back > 0) for (let i = back; i < out.length; i++) out[i] += out[i - back];
  if (per > 1) for (let i = 0; i < out.length; i++) out[i] /= per;
  return out;
}
