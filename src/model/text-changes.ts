/** How a text differs from an earlier one, by lines. */

/** Old lines [oldFrom, oldTo) became new lines [newFrom, newTo); one of the two may be empty. Lines count from 1. */
export interface LineHunk {
  readonly oldFrom: number;
  readonly oldTo: number;
  readonly newFrom: number;
  readonly newTo: number;
}

export type HunkKind = 'added' | 'removed' | 'changed';

export function kindOf({ oldFrom, oldTo, newFrom, newTo }: LineHunk): HunkKind {
  if (oldFrom === oldTo) return 'added';
  return newFrom === newTo ? 'removed' : 'changed';
}
