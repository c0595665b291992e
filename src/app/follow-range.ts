/**
 * The played range follows the clips: when other clips are shown (files opened, a take chosen, undo), a range that was
 * theirs becomes that of the new ones. A range that someone set by hand stays.
 */
import type { Playback } from '../edit/playback.ts';
import type { Store } from '../edit/store.ts';
import { rangeOfClips } from '../model/document.ts';
import type { Observable } from '../ui/observable.ts';

export function followRange(store: Store, transport: Observable<Playback>): void {
  let clips = rangeOfClips(store.document);
  store.subscribe((now, before) => {
    if (now.document === before.document) return;
    const next = rangeOfClips(now.document);
    const was = clips;
    clips = next;
    transport.update((playback) => {
      if (sameRange(was, next) || !sameRange(playback.range, was ?? playback.range)) return playback;
      // Without a clip there is nothing to play, and no moment is another.
      if (!next) return { ...playback, range: [0, 0], timeSeconds: 0, playing: false };
      return { ...playback, range: next };
    });
  });
}

function sameRange(a: readonly [number, number] | undefined, b: readonly [number, number] | undefined): boolean {
  return a?.[0] === b?.[0] && a?.[1] === b?.[1];
}
