/** Looks for numbers that no document may hold. */

/** The path of the first number that isn't finite: `skeletons.0.joints.1.pose.0: NaN`; undefined without one. */
export function notFinite(value: unknown): string | undefined {
  if (typeof value === 'number') return Number.isFinite(value) ? undefined : String(value);
  if (typeof value !== 'object' || value === null) return undefined;
  if (value instanceof Float64Array || value instanceof Float32Array) {
    const at = value.findIndex((each) => each - each !== 0);
    return at < 0 ? undefined : `${at}: ${value[at]}`;
  }
  if (ArrayBuffer.isView(value)) return undefined;
  for (const [key, own] of Object.entries(value)) {
    // Motion capture has none.
    if (key === 'limits') continue;
    const path = notFinite(own);
    if (path) return `${key}.${path}`;
  }
  return undefined;
}
