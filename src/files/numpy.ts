/** Files of numpy's arrays: fetched when there are any. */
import type { Import } from '../import/imported.ts';
import { readNumpy } from '../import/numpy/read.ts';
import type { ContentOf, WholeCharacter } from '../model/files.ts';
import type { ImportedFile } from './imports.ts';

/** Reads a `.npy` or `.npz`: each root is a character. Never throws for anything that the file holds. */
export function readNumpyFile(given: Import): ImportedFile<ContentOf<'character'>> {
  const { value, diagnostics } = readNumpy(given);
  if (!value) return { diagnostics, beside: [] };
  const characters = value.captures.map(
    ({ skeleton, take }): WholeCharacter => ({
      ...{ skeleton, skins: [], morphs: [], takes: take ? [take] : [], textures: [] },
      space: value.space,
    }),
  );
  return { value: { kind: 'character', characters }, diagnostics, beside: [] };
}
