/** Writes `.morph`. Empty blocks are omitted. */
import type { Morph, MorphRows } from '../../model/morph.ts';
import type { WriteResult } from '../reader.ts';
import { Text } from '../write-text.ts';

/** Writes a `.morph`. @param fileName appears in diagnostics */
export function writeMorph(morph: Morph, fileName = ''): WriteResult {
  const text = new Text(fileName);
  writeRows(text, 'positions', morph.positions);
  writeRows(text, 'normals', morph.normals);
  const { name, weight = 0 } = morph;
  if (weight !== 0) text.left('weight-left-out', `A .morph file stores no weight; ${name} starts with ${weight}.`);
  return text.result();
}

function writeRows(text: Text, what: string, { indices, values }: MorphRows): void {
  if (indices.length === 0) return;
  text.line(0, `${what} ${indices.length} {`);
  text.about(what);
  for (let i = 0; i < indices.length; i++) {
    text.row = i + 1;
    text.line(1, `${indices[i]} ${text.numbers([values[3 * i], values[3 * i + 1], values[3 * i + 2]])}`);
  }
  text.line(0, '}');
}
