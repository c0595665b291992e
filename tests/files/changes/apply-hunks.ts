import type { MergedText } from '../../../src/files/changes/merge.ts';
import { splitLines } from '../../../src/files/changes/text-lines.ts';

/** The original with its lines in hunks replaced by those of the text; lines outside are the original's. */
export function applyHunks(original: string, { text, hunks }: MergedText): string {
  const [own, changed] = [original, text].map((each) => {
    const { lines, ends } = splitLines(each);
    return lines.map((line, i) => line + ends[i]);
  });
  let applied = '';
  let at = 1;
  for (const { oldFrom, oldTo, newFrom, newTo } of hunks) {
    applied += own.slice(at - 1, oldFrom - 1).join('');
    // The last line may have had no line end.
    if (oldFrom > own.length && newTo > newFrom) applied += /\r*\n|\r/.exec(original)?.[0] ?? '\n';
    applied += changed.slice(newFrom - 1, newTo - 1).join('');
    at = oldTo;
  }
  return applied + own.slice(at - 1).join('');
}
