/**
 * A value with listeners. Deliberately tiny; the document has a store with history, and this is for everything else:
 * transport, settings, messages, progress.
 */
export interface Observable<T> {
  get(): T;
  set(next: T): void;
  /** Sets the result of `change`. */
  update(change: (now: T) => T): void;
  /** Calls back after each change, not immediately. Returns an unsubscribe function. */
  subscribe(listener: (now: T, before: T) => void): () => void;
}

/** Setting the same value notifies nobody. */
export function observable<T>(initial: T): Observable<T> {
  let value = initial;
  const listeners = new Set<(now: T, before: T) => void>();
  const set = (next: T): void => {
    if (Object.is(next, value)) return;
    const before = value;
    value = next;
    for (const listener of listeners) {
      // If a listener has set it again, the others have already been notified.
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
