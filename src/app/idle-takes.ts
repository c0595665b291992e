/**
 * Makes the channels of takes that still have none, one take whenever the page is idle, so that nothing waits for them
 * when another take is shown, or a command changes all of them.
 */
import type { Store } from '../edit/store.ts';
import type { Document } from '../model/document.ts';
import type { Take } from '../model/takes/take.ts';
import { trackedOf } from '../model/takes/tracked-take.ts';

/** @param whenIdle runs something later, once */
export function makeTakesWhenIdle(
  store: Pick<Store, 'document' | 'subscribe'>,
  whenIdle: (run: () => void) => void,
): void {
  let isWaiting = false;
  const wait = () => {
    if (isWaiting) return;
    isWaiting = true;
    whenIdle(() => {
      isWaiting = false;
      const take = trackedTake(store.document);
      // Asking for the channels makes them.
      if (take?.channels) wait();
    });
  };
  store.subscribe(({ document }, { document: before }) => {
    if (document.characters !== before.characters && trackedTake(document)) wait();
  });
}

function trackedTake({ characters }: Document): Take | undefined {
  for (const { takes } of characters) {
    const found = takes.find(trackedOf);
    if (found) return found;
  }
  return undefined;
}
