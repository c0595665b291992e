/**
 * Writes JSON for people to read: the fields of the file and the items of its lists a line each, all within them on
 * that line. Numbers are the shortest decimals that read back the same, −0 too, which `JSON.stringify` loses.
 */
import type { OtherFields } from '../../model/other-fields.ts';
import type { WriteResult } from '../reader.ts';
import { Text } from '../write-text.ts';

/**
 * Writes an object of a file.
 *
 * @param fields those that are undefined are left out
 * @param fileName appears in diagnostics
 * @throws UnwritableError for a number that isn't finite
 */
export function writeJson(fields: OtherFields, fileName = ''): WriteResult {
  const text = new Text(fileName);
  const lines = given(fields).map(([name, value]) => {
    text.about(name);
    const key = `  ${JSON.stringify(name)}: `;
    if (!isRows(value)) return key + inline(value, text);
    return `${key}[\n${value.map((row) => `    ${inline(row, text)}`).join(',\n')}\n  ]`;
  });
  return { text: lines.length ? `{\n${lines.join(',\n')}\n}\n` : '{}\n', diagnostics: [] };
}

/** A list of objects. */
function isRows(value: unknown): value is readonly object[] {
  return Array.isArray(value) && value.length > 0 && value.every((row) => typeof row === 'object' && row !== null);
}

function inline(value: unknown, text: Text): string {
  if (typeof value === 'number') return text.number(value);
  if (Array.isArray(value)) return `[${value.map((item) => inline(item, text)).join(', ')}]`;
  if (typeof value !== 'object' || value === null) return JSON.stringify(value);
  const fields = given(value).map(([name, field]) => `${JSON.stringify(name)}: ${inline(field, text)}`);
  return fields.length ? `{ ${fields.join(', ')} }` : '{}';
}

function given(fields: object): readonly (readonly [string, unknown])[] {
  return Object.entries(fields).filter(([, value]) => value !== undefined);
}
