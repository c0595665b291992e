/**
 * Cells of a CSV that a spreadsheet would run as a formula. Excel, LibreOffice and Sheets take what begins with one of
 * these characters as such, in a file name too; an apostrophe before it makes it text.
 */
const FORMULA = /^[\s']*[=+\-@\t\r＝＋－＠]/;

/** The text with an apostrophe in front, if it could run. */
export function harmless(text: string): string {
  return FORMULA.test(text) ? `'${text}` : text;
}

/** The text that `harmless` was given. */
export function meant(cell: string): string {
  return cell.startsWith("'") && FORMULA.test(cell.slice(1)) ? cell.slice(1) : cell;
}

/** A cell: separators of any country are quoted, and spaces at the ends, which some programs trim. */
export function quoted(cell: string): string {
  return /[",;\t\r\n]|^\s|\s$/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell;
}
