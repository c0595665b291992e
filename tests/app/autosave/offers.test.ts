import { describe, expect, it } from 'vitest';
import { KeptOffers } from '../../../src/app/autosave/offers.ts';
import { SESSION_VERSION } from '../../../src/app/autosave/session-state.ts';
import type { KeptOffer } from '../../../src/ui/state/kept-offer.ts';
import { observable } from '../../../src/ui/widgets/observable.ts';
import { memoryLocks, memoryStore } from './memory-store.ts';

/** Offers of left-behind sessions, oldest first, as a page finds them. */
async function offersOf(...ids: readonly string[]) {
  const store = memoryStore();
  ids.forEach((id, i) => {
    const card = { id, version: SESSION_VERSION, savedAtMs: Date.now() - 1000 * (ids.length - i), characters: [] };
    store.sessions.set(id, { card, head: undefined, files: new Map(), pieces: new Map(), chunks: new Map() });
  });
  const shown = observable<KeptOffer | undefined>(undefined);
  const restored: string[] = [];
  const offers = new KeptOffers(store, memoryLocks(), shown, async (id) => void restored.push(id));
  await offers.find('own');
  return { offers, shown, restored, works: () => shown.get()?.works.map(({ id }) => id) };
}

describe('work that was left behind', () => {
  it('left-behind sessions are offered, the newest first', async () => {
    const { shown, works } = await offersOf('older', 'newer');
    expect(works()).toEqual(['newer', 'older']);
    expect(shown.get()).toMatchObject({ isPutOff: false, isAskedFor: false });
  });

  it('an offer can be requested again after “not now”', async () => {
    const { shown, restored, works } = await offersOf('work');
    shown.get()?.later();
    expect(shown.get()?.isPutOff).toBe(true);
    expect(works()).toEqual(['work']);
    shown.get()?.again();
    expect(shown.get()).toMatchObject({ isPutOff: false, isAskedFor: true });
    shown.get()?.restore('work');
    expect(restored).toEqual(['work']);
  });

  it('a postponed offer stays postponed when something else happens', async () => {
    const { offers, shown } = await offersOf('work');
    shown.get()?.later();
    offers.setAside();
    expect(shown.get()).toMatchObject({ isPutOff: true, isAside: true });
  });

  it('a session in use is not offered any more; the others are available on request', async () => {
    const { offers, shown, works } = await offersOf('older', 'newer');
    shown.get()?.restore('newer');
    offers.taken('newer');
    expect(works()).toEqual(['older']);
    expect(shown.get()?.isPutOff).toBe(true);
    offers.taken('older');
    expect(shown.get()).toBeUndefined();
  });
});
