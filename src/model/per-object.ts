/**
 * What is worked out once for an immutable object and kept as long as that object is: compiled skeletons, normals,
 * bounds. The document never changes an object, so nothing kept can be out of date.
 *
 *     export const compileSkeleton = perObject((skeleton: Skeleton) => compile(skeleton));
 */

/** A function that remembers its results by the identity of its argument. */
export interface PerObject<K extends WeakKey, V> {
  (of: K): V;
  /** Takes over a result that was made elsewhere, in a worker for example. */
  adopt(of: K, value: V): void;
}

export function perObject<K extends WeakKey, V>(make: (of: K) => V): PerObject<K, V> {
  const known = new WeakMap<K, V>();
  const get = (of: K): V => {
    let value = known.get(of);
    if (value === undefined && !known.has(of)) {
      value = make(of);
      known.set(of, value);
    }
    // Undefined only where that is what was made.
    return value as V;
  };
  return Object.assign(get, { adopt: (of: K, value: V) => void known.set(of, value) });
}

/** The same for a result of two objects: it goes as soon as either does. */
export function perPair<A extends WeakKey, B extends WeakKey, V>(make: (a: A, b: B) => V): (a: A, b: B) => V {
  const byFirst = perObject((a: A) => perObject((b: B) => make(a, b)));
  return (a, b) => byFirst(a)(b);
}
