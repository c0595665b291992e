/** A number of three digits for sentences; exact ones are elsewhere. */
export function shortNumber(value: number): string {
  return String(Number(value.toPrecision(3)));
}
