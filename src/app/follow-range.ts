/**
 * The playback range and frame rate follow the takes: when other takes are shown (files opened, a take selected or its
 * range set, undo), a range taken from the takes becomes that of the new ones. A range set by hand stays.
 *
 * The frame rate is taken from takes opened into an empty page, or replacing everything, if they share one. After that
 * it is the user's, until a take is played alone.
 *
 * Without a take there is still a range, since poses need a timeline to be keyed on: the one before the takes came.
 */
import { sharedFrameRate } from '../edit/frame-rate.ts';
import { countedAt, DEFAULT_PLAYBACK, intoRange, type Playback } from '../edit/playback.ts';
import type { Store } from '../edit/store.ts';
import { findCharacter, rangeOfTakes } from '../model/document.ts';
import type { Observable } from '../ui/widgets/observable.ts';

type Range = readonly [number, number];

export function followRange(store: Store, transport: Observable<Playback>): void {
  let takes = rangeOfTakes(store.document);
  let withoutTakes: Range = takes ? DEFAULT_PLAYBACK.range : transport.get().range;
  store.subscribe((now, before) => {
    if (now.document === before.document) return;
    const next = rangeOfTakes(now.document);
    const was = takes;
    takes = next;
    // The timeline of another character says nothing about this one's.
    const isOther =
      before.document.characters.length > 0 &&
      !now.document.characters.some((c) => findCharacter(before.document, c.id));
    const isFirst = before.document.characters.length === 0;
    if (isOther || isFirst) transport.update((playback) => countedAt(playback, sharedFrameRate(now.document)));
    if (isOther) withoutTakes = DEFAULT_PLAYBACK.range;
    else if (!was && next) withoutTakes = transport.get().range;
    if (sameRange(was, next) && !(isOther && !next)) return;
    transport.update((playback) => {
      if (!next) return pausePlayback(playback, was, withoutTakes, isOther);
      return sameRange(playback.range, was ?? playback.range) ? { ...playback, range: next } : playback;
    });
  });
}

/** Nothing is animated any more. The time stays, clamped to the range. */
function pausePlayback(playback: Playback, was: Range | undefined, otherwise: Range, isOther: boolean): Playback {
  const range = isOther || sameRange(playback.range, was) ? otherwise : playback.range;
  const stopped = { ...playback, range, playing: false };
  return isOther ? { ...stopped, timeSeconds: range[0] } : intoRange(stopped);
}

function sameRange(a: Range | undefined, b: Range | undefined): boolean {
  return a?.[0] === b?.[0] && a?.[1] === b?.[1];
}
