/** Files of points over time: fetched when there are any. */
import type { Import } from '../import/imported.ts';
import { type PointsKind, type ReadPoints, readPoints } from '../import/points/read.ts';
import type { ContentOf, WholeCharacter } from '../model/files.ts';
import { arePoints } from '../model/skeleton/joint-types.ts';
import type { ImportedFile } from './imports.ts';

/** Reads points as characters. Never throws for anything that the file holds. */
export function readPointsFile(kind: PointsKind, given: Import): ImportedFile<ContentOf<'character'>> {
  const { value, diagnostics } = readPoints(kind, given);
  return { ...(value && { value: wholeOf(value) }), diagnostics, beside: [] };
}

/** Reads a `.trc`, whose points are written to it again; those with bones are written to other files. */
export function readTrcFile(given: Import): ImportedFile<ContentOf<'trc'> | ContentOf<'character'>> {
  const { value, diagnostics } = readPoints('trc', given);
  const [capture] = value?.captures ?? [];
  if (!value || !arePoints(capture.skeleton))
    return { ...(value && { value: wholeOf(value) }), diagnostics, beside: [] };
  return { value: { kind: 'trc', capture, space: value.space }, diagnostics, beside: [] };
}

/** Reads a table of points; one with other columns is left to the reader of numbers. */
export function readTable(given: Import): ImportedFile<ContentOf<'character'>> {
  const read = readPointsFile('csv', given);
  return read.value || read.diagnostics.length > 0 ? read : { ...read, isOther: true };
}

function wholeOf({ captures, space }: ReadPoints): ContentOf<'character'> {
  const characters = captures.map(
    ({ skeleton, take }): WholeCharacter => ({
      ...{ skeleton, skins: [], morphs: [], takes: take ? [take] : [], textures: [] },
      space,
    }),
  );
  return { kind: 'character', characters };
}
