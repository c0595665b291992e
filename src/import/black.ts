/** Linear red, green and blue that are hardly seen. */
const DARK = 0.01;

/** Whether a colour shows nothing. */
export function isBlack(color: readonly number[] | undefined): boolean {
  return color?.slice(0, 3).every((part) => part <= DARK) ?? false;
}
