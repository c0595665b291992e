/** Names as files can hold them: characters that would end them become `_`. */

/** For names that are one word: blanks and braces end it. */
export function oneToken(name: string): string {
  return wellFormed(name).replace(/[ \t\r\n{}]/g, '_');
}

/** For names that are the rest of a line. Inner blanks are fine; leading and trailing ones would be trimmed. */
export function restOfLine(name: string): string {
  const written = wellFormed(name).replace(/[\r\n{}]/g, '_');
  const from = /^[ \t]*/.exec(written)?.[0].length ?? 0;
  let to = written.length;
  while (to > from && (written[to - 1] === ' ' || written[to - 1] === '\t')) to--;
  return '_'.repeat(from) + written.slice(from, to) + '_'.repeat(written.length - to);
}

/** Lone surrogates can't be encoded as UTF-8. */
export function wellFormed(name: string): string {
  return name.replace(/\p{Surrogate}/gu, '_');
}
