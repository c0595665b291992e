/** Writes `.sets.json`, a line for each set and each joint with locks. */
import type { SetsByName } from '../../model/sets-by-name.ts';
import { writeJson } from '../json/write.ts';
import type { WriteResult } from '../reader.ts';

/** `fileName` appears in diagnostics. */
export function writeSets({ sets, locked, others }: SetsByName, fileName = ''): WriteResult {
  const rows = (list: readonly { readonly others?: object }[]) =>
    list.map(({ others: kept, ...row }) => ({ ...row, ...kept }));
  return writeJson({ sets: rows(sets), locked: rows(locked), ...others }, fileName);
}
