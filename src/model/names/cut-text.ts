/** Text of files, names above all, cut to what a person reads: a joint may be called a megabyte. */

/** Characters of a name or word that a message, a label or a tooltip shows at most. */
export const MAX_SHOWN = 200;
/** Characters of a whole message, tooltip or accessible name. */
const LONGEST_MESSAGE = 1000;

/**
 * Length searched of a message, times what is left of it: long words and names before and after what is shown count
 * too.
 */
const MAX_SEARCHED = 20;

/** Words, and names in quotes. */
const LONG_PIECES = new RegExp(`[^\\s"]{${MAX_SHOWN + 1},}|"[^"]{${MAX_SHOWN},}"`, 'g');

/** The text, or its beginning and end with an ellipsis between: at most `most` characters. */
export function cutText(text: string, most = MAX_SHOWN): string {
  if (text.length <= most) return text;
  const tail = Math.floor((most - 1) / 2);
  const head = most - 1 - tail;
  const end = isLowSurrogate(text, head) ? head - 1 : head;
  const start = text.length - tail;
  return `${text.slice(0, end)}…${text.slice(isLowSurrogate(text, start) ? start + 1 : start)}`;
}

/** A message of at most `most` characters, its long words and quoted names cut; the same text if none is long. */
export function cutMessage(message: string, most = LONGEST_MESSAGE): string {
  if (message.length <= MAX_SHOWN) return message;
  // A megabyte would be searched for milliseconds, each time it is shown.
  const searched = cutText(message, MAX_SEARCHED * most);
  return cutText(
    searched.replace(LONG_PIECES, (piece) => cutText(piece)),
    most,
  );
}

function isLowSurrogate(text: string, at: number): boolean {
  const code = text.charCodeAt(at);
  return code >= 0xdc00 && code <= 0xdfff;
}
