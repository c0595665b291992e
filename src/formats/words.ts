/** Words from bytes, and explanations of invalid numbers. */

/** Longer words are cut in messages, and are never keywords. */
export const LONGEST_KEYWORD = 40;

const LONGEST_NAME = 100;

/** Keeps byte-order marks inside names. */
const UTF8 = new TextDecoder('utf-8', { ignoreBOM: true });

/** Bytes [start, end) as text. For keywords a call of the decoder would cost more than the loop. */
export function textOf(bytes: Uint8Array, start: number, end: number): string {
  if (end - start > LONGEST_KEYWORD) return UTF8.decode(bytes.subarray(start, end));
  let text = '';
  for (let i = start; i < end; i++) {
    if (bytes[i] >= 0x80) return UTF8.decode(bytes.subarray(start, end));
    text += String.fromCharCode(bytes[i]);
  }
  return text;
}

/** A name from the file for a message, shortened. */
export function shortName(name: string): string {
  return name.length > LONGEST_NAME ? `${name.slice(0, LONGEST_NAME)}…` : name;
}

/** The error's code, and the end of its sentence. */
export function whyNoNumber(text: string): { code: string; why: string } {
  const code = 'not-a-number';
  const word = text.slice(0, 400).toLowerCase();
  if (/^[+-]?(\d+(?:\.\d*)?|\.\d+)(e[+-]?\d+)?$/.test(word)) {
    return { code: 'number-too-large', why: ': too large for a number' };
  }
  if (/^[+-]?nan/.test(word)) return { code, why: ', which is not a number' };
  if (/^[+-]?inf/.test(word)) return { code, why: ': a number must be finite' };
  if (/^[+-]?0x/.test(word)) return { code, why: ': a number must be decimal, not hexadecimal' };
  if (/^[+-]?\d*,\d*(e[+-]?\d+)?$/.test(word)) return { code, why: ': use a decimal point, not a comma' };
  if (/^[+-]?(\d|\.\d)/.test(word)) return { code, why: ', which has extra characters after the number' };
  return { code, why: '' };
}
