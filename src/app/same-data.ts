/**
 * Whether two pieces of plain data are the same, by content. What is the same object is not looked into: documents share
 * what did not change, so a comparison costs about as much as the change did. -0 counts as 0, NaN as itself.
 *
 * Not `deltaTo` of the history, asked whether there is a delta: that one goes through everything and copies what
 * differs, where this stops at the first difference; and undo has to bring -0 back, where nobody would save a file for it.
 */
export function sameData(a: unknown, b: unknown): boolean {
  if (a === b) return true;
  if (typeof a !== 'object' || typeof b !== 'object' || a === null || b === null) {
    return Number.isNaN(a) && Number.isNaN(b);
  }
  if (isColumn(a)) return isColumn(b) && sameColumn(a, b);
  if (Array.isArray(a)) {
    return Array.isArray(b) && a.length === b.length && a.every((item, i) => sameData(item, b[i]));
  }
  if (Array.isArray(b) || isColumn(b)) return false;
  // Plain records by now.
  const [left, right] = [Object.entries(a), new Map<string, unknown>(Object.entries(b))];
  return left.length === right.size && left.every(([key, value]) => right.has(key) && sameData(value, right.get(key)));
}

/** Any typed array. */
type Column = Float64Array | Float32Array | Uint32Array | Int32Array | Uint16Array | Uint8Array;

function isColumn(value: object): value is Column {
  return ArrayBuffer.isView(value) && !(value instanceof DataView);
}

/**
 * Where two columns differed last. A drag asks again at each move, and the key that it moves is where it was: looking
 * there first saves going over the 100,000 keys before it. Only ever a hint.
 */
let lastDifference = 0;

function sameColumn(a: Column, b: Column): boolean {
  if (a.length !== b.length) return false;
  if (lastDifference < a.length && differ(a[lastDifference], b[lastDifference])) return false;
  for (let i = 0; i < a.length; i++) {
    if (!differ(a[i], b[i])) continue;
    lastDifference = i;
    return false;
  }
  return true;
}

/** NaN is no number of any file, but of some computation. */
function differ(a: number, b: number): boolean {
  return a !== b && !(Number.isNaN(a) && Number.isNaN(b));
}
