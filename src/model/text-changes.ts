/** How a text differs from an earlier one, by lines. */

/** Old lines [oldFrom, oldTo) became new lines [newFrom, newTo); one of the two may be empty. Lines count from 1. */
export interface LineHunk {
  readonly oldFrom: number;
  readonly oldTo: number;
  readonly newFrom: number;
  readonly newTo: number;
}

/** Whether the lines of a hunk are only in the new text, only in the old one, or differ. */
export type HunkKind = 'added' | 'removed' | 'changed';

/** Kind of a hunk, by which of its two ranges of lines is empty. */
export function kindOf({ oldFrom, oldTo, newFrom, newTo }: LineHunk): HunkKind {
  if (oldFrom === oldTo) return 'added';
  return newFrom === newTo ? 'removed' : 'changed';
}

/** The new number of an old line; undefined for one in a hunk. */
export function lineNow(hunks: readonly LineHunk[], line: number): number | undefined {
  let moved = 0;
  for (const { oldFrom, oldTo, newTo } of hunks) {
    if (line < oldFrom) break;
    if (line < oldTo) return undefined;
    moved = newTo - oldTo;
  }
  return line + moved;
}

/** How many lines were changed, added and removed. */
export function countsOf(hunks: readonly LineHunk[]): { readonly [K in HunkKind]: number } {
  const counts = { changed: 0, added: 0, removed: 0 };
  for (const { oldFrom, oldTo, newFrom, newTo } of hunks) {
    const both = Math.min(oldTo - oldFrom, newTo - newFrom);
    counts.changed += both;
    counts.added += newTo - newFrom - both;
    counts.removed += oldTo - oldFrom - both;
  }
  return counts;
}
