/** Writes arrays as one JSON object: nested lists, the last axis on a line of its own. */
import { type DataArray, sizeOf } from './data-array.ts';
import { shortest } from './table.ts';

/**
 * Writes arrays as JSON, in pieces to be written one after the other.
 * @param meta as the last member
 */
export function* jsonPieces(arrays: readonly DataArray[], meta: unknown): Generator<string> {
  yield '{\n';
  for (const array of arrays) {
    yield `${JSON.stringify(array.name)}: `;
    yield* nested(array, 0, 0);
    yield ',\n';
  }
  yield `"meta": ${JSON.stringify(meta)}\n}\n`;
}

function* nested(array: DataArray, axis: number, at: number): Generator<string> {
  const { shape } = array;
  if (axis >= shape.length - 1) {
    const count = shape.at(-1);
    yield count === undefined ? valueText(array, at) : `[${texts(array, at, count).join(', ')}]`;
    return;
  }
  const step = sizeOf(shape.slice(axis + 1));
  yield '[\n';
  for (let i = 0; i < shape[axis]; i++) {
    if (i > 0) yield ',\n';
    yield* nested(array, axis + 1, at + i * step);
  }
  yield '\n]';
}

function texts(array: DataArray, at: number, count: number): readonly string[] {
  return Array.from({ length: count }, (_, i) => valueText(array, at + i));
}

function valueText({ type, data }: DataArray, at: number): string {
  if (type === 'text') return JSON.stringify(data[at]);
  if (type === 'bool') return data[at] ? 'true' : 'false';
  // JSON knows no infinity; a take that has one is broken, and null says so.
  const value = type === 'float' ? shortest(data)(data[at]) : data[at];
  return JSON.stringify(value);
}
