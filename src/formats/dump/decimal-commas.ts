/** Numbers with decimal commas, as programs print them by the custom of their country. */

/** Characters that are looked at. */
const SAMPLE = 1 << 16;
const NUMBER = /^[-+]?\d+,\d+(?:[eE][-+]?\d+)?,?$/;

/**
 * The text with decimal points, if its commas are in numbers: no point is, each comma is between digits, and other
 * signs stand between the numbers of a line. Else the same text.
 */
export function withDecimalPoints(text: string): string {
  return hasDecimalCommas(text.slice(0, SAMPLE)) ? text.replace(/(\d),(?=\d)/g, '$1.') : text;
}

function hasDecimalCommas(text: string): boolean {
  if (!/\d,\d/.test(text) || /\d\.\d/.test(text)) return false;
  let isSeveral = false;
  // The last line may be cut.
  for (const line of text.split(/[\r\n]+/).slice(0, text.length < SAMPLE ? undefined : -1)) {
    const words = line.split(/[\s;|()[\]{}:=<>"']+/).filter((word) => /\d,\d/.test(word));
    if (!words.every((word) => NUMBER.test(word))) return false;
    isSeveral ||= words.length > 1;
  }
  return isSeveral;
}
