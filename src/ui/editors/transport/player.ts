/**
 * The clock. While playing, each frame advances the time by the elapsed seconds; whenever the time changes, the
 * viewport is updated and unkeyed changes are discarded.
 */
import { advance } from '../../../edit/playback.ts';
import type { Uses } from '../../state/workbench.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { dropStale, followUnkeyed } from '../posing/unkeyed-values.ts';

/** A tab that was in the background continues where it was. */
const LONGEST_STEP_SECONDS = 1;

/** Runs until aborted. @param ready time stands still until then; default: from the start */
export function startPlayer(
  wb: Uses<'store' | 'actions' | 'viewport' | 'transport' | 'settings' | 'messages'>,
  signal: AbortSignal,
  ready?: Promise<unknown>,
): void {
  let before: number | undefined;
  let isReady = ready === undefined;
  const queue = oncePerFrame((nowMs) => {
    if (signal.aborted || !wb.transport.get().playing) return;
    const elapsed = before === undefined ? 0 : Math.min(LONGEST_STEP_SECONDS, (nowMs - before) / 1000);
    before = nowMs;
    // If it throws, playback continues.
    queue();
    wb.transport.update((p) => advance(p, elapsed));
  }, 'advance');
  const stop = wb.transport.subscribe((now, then) => {
    if (now.playing && !then.playing) before = undefined;
    if (now.playing && isReady) queue();
    if (now.timeSeconds !== then.timeSeconds) showTime(wb, now.timeSeconds);
  });
  const stopFollowing = followUnkeyed(wb);
  signal.addEventListener('abort', () => {
    stop();
    stopFollowing();
  });
  const begin = () => {
    isReady = true;
    if (wb.transport.get().playing) queue();
  };
  if (ready) void ready.then(begin);
  else begin();
  wb.viewport.seek(wb.transport.get().timeSeconds);
}

function showTime(wb: Uses<'store' | 'actions' | 'viewport' | 'settings' | 'messages'>, timeSeconds: number): void {
  dropStale(wb, timeSeconds);
  wb.viewport.seek(timeSeconds);
}
