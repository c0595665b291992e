/** Numbers of links and of the element's attributes. */

/** Beyond these digits no pixel changes. */
const DIGITS = 7;

/** A number as short as may be. */
export function numberText(value: number): string {
  return `${Number(value.toPrecision(DIGITS)) + 0}`;
}
