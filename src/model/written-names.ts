/** Names as files can hold them: what would end them there becomes `_`. */

/** Where a name is one word: blanks and braces end it. */
export function oneToken(name: string): string {
  return wellFormed(name).replace(/[ \t\r\n{}]/g, '_');
}

/** Where it is the rest of a line. Blanks inside are fine; those at an end would be taken for none of it. */
export function restOfLine(name: string): string {
  return wellFormed(name)
    .replace(/[\r\n{}]/g, '_')
    .replace(/^[ \t]+|[ \t]+$/g, (blanks) => '_'.repeat(blanks.length));
}

/** Half a surrogate pair has no UTF-8. */
export function wellFormed(name: string): string {
  return name.replace(/\p{Surrogate}/gu, '_');
}
