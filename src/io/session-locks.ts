/**
 * Which sessions someone is working in: each page holds a Web Lock for its own, and the browser lets go of it when the
 * page is gone, however it went. (A heartbeat in the store would take a page that the browser put to sleep for dead.)
 */

export interface SessionLocks {
  /**
   * Takes a session's lock, for good or until the way out is called.
   * @param patienceMs how long to wait for whoever holds it: a page that is being reloaded may still do so
   * @returns the way out; undefined where someone else holds on to it
   */
  hold(id: string, patienceMs?: number): Promise<(() => void) | undefined>;
}

/** undefined where the browser has no locks, or keeps them from pages that came without encryption. */
export function sessionLocks(): SessionLocks | undefined {
  // Typed as always there; it is not on plain http.
  const locks = navigator.locks as LockManager | undefined;
  if (!locks) return undefined;
  return {
    hold: async (id, patienceMs = 0) => {
      const name = `marrow-session-${id}`;
      const now = await take(locks, name, { ifAvailable: true });
      if (now || patienceMs === 0) return now;
      return take(locks, name, { signal: AbortSignal.timeout(patienceMs) });
    },
  };
}

function take(locks: LockManager, name: string, options: LockOptions): Promise<(() => void) | undefined> {
  return new Promise((resolve, reject) => {
    locks
      .request(name, options, (lock) => {
        if (!lock) {
          resolve(undefined);
          return undefined;
        }
        return new Promise<void>((release) => resolve(release));
      })
      .catch((error: unknown) => {
        if (error instanceof DOMException && error.name === 'TimeoutError') resolve(undefined);
        else reject(error);
      });
  });
}
