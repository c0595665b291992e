/** When a panel shows the time again. */
import type { Playback } from '../../edit/playback.ts';
import { oncePerFrame } from '../widgets/frame.ts';
import type { Observable } from '../widgets/observable.ts';

/**
 * Shows numbers of the current time: in the next frame, and while it plays, at most ten times a second, together with
 * all others. What it stops at is shown. Returns an unsubscribe function.
 */
export function followWithNumbers(transport: Pick<Observable<Playback>, 'subscribe'>, show: () => void): () => void {
  const soon = oncePerFrame(show);
  const inTurn = oncePerFrame(show, 'number');
  return transport.subscribe((now, before) => {
    if (now.timeSeconds === before.timeSeconds && now.playing === before.playing) return;
    if (now.playing && before.playing) inTurn();
    else soon();
  });
}
