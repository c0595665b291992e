/**
 * The digits in names. Names come from files and may have a million letters: a regular expression that looks for their
 * end would begin again at each digit.
 */

/** The last digits of a name, wherever they are: `7` of `joint7_end`; undefined if it has none. */
export function lastDigitsIn(name: string): string | undefined {
  let end = name.length;
  while (end > 0 && !isDigit(name, end - 1)) end--;
  return end === 0 ? undefined : name.slice(startOfDigits(name, end), end);
}

/** Where the digits that end a name begin; its length if it ends with none. @param most digits that are of interest */
export function trailingDigitsAt(name: string, most: number): number {
  return Math.max(startOfDigits(name, name.length), name.length - most);
}

function startOfDigits(name: string, end: number): number {
  let start = end;
  while (start > 0 && isDigit(name, start - 1)) start--;
  return start;
}

function isDigit(name: string, at: number): boolean {
  const code = name.charCodeAt(at);
  return code >= 48 && code <= 57;
}
