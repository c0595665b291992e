/**
 * Caches what is computed from an immutable object for as long as the object lives: compiled skeletons, normals,
 * bounds. The document never mutates an object, so the cache is never stale.
 *
 *     export const compileSkeleton = perObject((skeleton: Skeleton) => compile(skeleton));
 */

/** A function memoised by the identity of its argument. */
export interface PerObject<K extends WeakKey, V> {
  (of: K): V;
  /** Stores a result that was computed elsewhere, e.g. in a worker. */
  adopt(of: K, value: V): void;
}

/**
 * Makes a function that calls `make` once per object and then returns the same value for as long as the object lives.
 * Its `adopt` stores a value computed elsewhere.
 */
export function perObject<K extends WeakKey, V>(make: (of: K) => V): PerObject<K, V> {
  const known = new WeakMap<K, V>();
  const get = (of: K): V => {
    let value = known.get(of);
    if (value === undefined && !known.has(of)) {
      value = make(of);
      known.set(of, value);
    }
    // Undefined only if that is what `make` returned.
    return value as V;
  };
  return Object.assign(get, { adopt: (of: K, value: V) => void known.set(of, value) });
}

/** Caches what is computed from two objects, like `perObject`: the entry is collected as soon as either object is. */
export function perPair<A extends WeakKey, B extends WeakKey, V>(make: (a: A, b: B) => V): (a: A, b: B) => V {
  const byFirst = perObject((a: A) => perObject((b: B) => make(a, b)));
  return (a, b) => byFirst(a)(b);
}
