/**
 * An error as a sentence. Our own errors have one; what browsers say of theirs is about arrays and `postMessage`, so it
 * is told in words of ours. Ours are Errors, or of classes of their own; those of the language and of the DOM are not.
 */
import { UserError } from './user-error.ts';

const MEMORY = 'There is not enough memory for this. Close other tabs, or use smaller files.';

/** By name and message, as Chromium, Firefox and Safari put them. */
const OF_BROWSERS: readonly (readonly [RegExp, string])[] = [
  [/^(Range|Internal)Error.*(call stack|recursion)/, 'This is nested too deeply.'],
  [/^DataCloneError|^RangeError.*(memory|alloc|length|size)/i, MEMORY],
  [/^Not(Found|Readable)Error/, 'The file has moved or can no longer be read. Open it again.'],
  [/^QuotaExceededError/, 'The browser has no storage left.'],
  [/^TypeError.*import/i, 'Part of the page could not be loaded. Check your connection.'],
  [/^(NotAllowed|Security)Error/, 'The browser does not allow it.'],
];

const OF_THE_LANGUAGE = /^(Type|Range|Reference|Syntax|URI|Eval|Internal)Error$/;
/** Length to which unexpected messages are quoted: enough to find out more by. */
const MAX_QUOTED = 160;

/**
 * The sentence that tells a person about an error.
 * @param error anything that was thrown
 */
export function sentenceOf(error: unknown): string {
  if (error instanceof UserError) return error.message;
  if (!(error instanceof Error)) return String(error);
  const said = `${error.name}: ${error.message}`;
  const known = OF_BROWSERS.find(([pattern]) => pattern.test(said))?.[1];
  if (known !== undefined) return known;
  const isOurs = !OF_THE_LANGUAGE.test(error.name) && error.constructor.name !== 'DOMException';
  return isOurs ? error.message : `Something went wrong. Try again. (${said.slice(0, MAX_QUOTED)})`;
}
