/**
 * The clock. While the transport plays, each frame moves it on by the seconds that went by between frames; and whenever
 * its time changes, by play or by hand, the viewport is told and hand-set values that were not keyed go.
 */
import { advance } from '../../../edit/playback.ts';
import type { Uses } from '../../state/workbench.ts';
import { dropStale, followUnkeyed } from '../posing/unkeyed-values.ts';

/** A tab that was in the background for an hour goes on where it was, not an hour later. */
const LONGEST_STEP_SECONDS = 1;

/** Runs until the signal says otherwise. */
export function startPlayer(
  wb: Uses<'store' | 'actions' | 'viewport' | 'transport' | 'settings' | 'messages'>,
  signal: AbortSignal,
): void {
  let before: number | undefined;
  let queued = 0;
  const tick = (now: number) => {
    try {
      if (!wb.transport.get().playing) return;
      const elapsed = before === undefined ? 0 : Math.min(LONGEST_STEP_SECONDS, (now - before) / 1000);
      before = now;
      wb.transport.update((p) => advance(p, elapsed));
    } finally {
      // Only after all that the new time has asked for: first, the next tick would come before the picture of this one,
      // which would pass for its own too. There would be a picture in every second frame.
      queued = 0;
      if (wb.transport.get().playing) queue();
    }
  };
  const queue = () => {
    if (queued === 0 && !signal.aborted) queued = requestAnimationFrame(tick);
  };
  const stop = wb.transport.subscribe((now, then) => {
    if (now.playing && !then.playing) before = undefined;
    if (now.playing) queue();
    if (now.timeSeconds !== then.timeSeconds) showTime(wb, now.timeSeconds);
  });
  const stopFollowing = followUnkeyed(wb);
  signal.addEventListener('abort', () => {
    stop();
    stopFollowing();
    cancelAnimationFrame(queued);
  });
  if (wb.transport.get().playing) queue();
  wb.viewport.seek(wb.transport.get().timeSeconds);
}

function showTime(wb: Uses<'store' | 'actions' | 'viewport' | 'settings' | 'messages'>, timeSeconds: number): void {
  dropStale(wb, timeSeconds);
  wb.viewport.seek(timeSeconds);
}
