/**
 * What failed, as a sentence. Our own errors have one; what browsers say of theirs is about arrays and `postMessage`, so
 * it is told in words of ours.
 */

const MEMORY = 'There is not enough memory for this. Close other tabs, or use smaller files.';

/** By name and message, as Chromium, Firefox and Safari put them. */
const OF_BROWSERS: readonly (readonly [RegExp, string])[] = [
  [/^(Range|Internal)Error.*(call stack|recursion)/, 'This is nested too deeply.'],
  [/^DataCloneError|^RangeError.*(memory|alloc|length|size)/i, MEMORY],
  [/^Not(Found|Readable)Error/, 'The file has moved, or may not be read any more. Open it again.'],
  [/^QuotaExceededError/, 'The browser has no storage left.'],
];

/** @param error anything that was thrown */
export function sentenceOf(error: unknown): string {
  if (!(error instanceof Error)) return String(error);
  const said = `${error.name}: ${error.message}`;
  return OF_BROWSERS.find(([pattern]) => pattern.test(said))?.[1] ?? error.message;
}
