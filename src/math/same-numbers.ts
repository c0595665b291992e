/** Whether two arrays are equal, number by number; 0 equals −0, NaN nothing. Allocates nothing. */
export function sameNumbers(a: Float64Array, b: Float64Array): boolean {
  if (a.length !== b.length) return false;
  for (let i = 0; i < a.length; i++) if (a[i] !== b[i]) return false;
  return true;
}
