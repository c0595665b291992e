/**
 * A value that tells when it changes. Small enough to be read in one glance; the document has a store of its own, with
 * history, and this is for everything beside it: transport, settings, messages, progress.
 */
export interface Observable<T> {
  get(): T;
  set(next: T): void;
  /** `set` of what `change` makes of the value. */
  update(change: (now: T) => T): void;
  /** Calls back after each change, not at once. Returns the way out. */
  subscribe(listener: (now: T, before: T) => void): () => void;
}

/** Setting the very same value tells nobody. */
export function observable<T>(initial: T): Observable<T> {
  let value = initial;
  const listeners = new Set<(now: T, before: T) => void>();
  const set = (next: T): void => {
    if (Object.is(next, value)) return;
    const before = value;
    value = next;
    for (const listener of listeners) {
      // A listener may have set it anew: whoever is left has then been told already.
      if (!Object.is(value, next)) return;
      listener(next, before);
    }
  };
  return {
    get: () => value,
    set,
    update: (change) => set(change(value)),
    subscribe(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
  };
}
