/**
 * Which sessions are in use: each page holds a Web Lock for its own, and the browser releases it when the page is gone
 * for any reason. (With a heartbeat in the store, a page that the browser suspended would look dead.)
 */

export interface SessionLocks {
  /**
   * Takes a session's lock, until the page is closed or the returned function is called.
   * @param patienceMs how long to wait for the holder, which may be this page before a reload
   * @returns a function that releases the lock; undefined if someone else holds it
   */
  hold(id: string, patienceMs?: number): Promise<(() => void) | undefined>;
}

/** Undefined if the browser has no locks, or withholds them from unencrypted pages. */
export function sessionLocks(): SessionLocks | undefined {
  // The type says it always exists; on plain http it doesn't.
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
