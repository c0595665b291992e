/**
 * Keying during playback. A key press falls between two frames, and a key there would be at a time that no frame shows.
 * So playback stops, as one would do by hand before keying: on the nearest frame, or at the exact time if time isn't
 * counted in frames. What is shown then is what is keyed. (Continuing playback and keying the nearest frame would key
 * another pose than the one on screen.)
 */
import { playsSamples } from '../../edit/frame-rate.ts';
import { pause } from '../../edit/playback.ts';
import type { Uses, Workbench } from './workbench.ts';

type Parts = Pick<Workbench, 'store' | 'transport' | 'timeline' | 'settings'>;

/**
 * Whether pausing snaps to a frame: if time is in frames, or if what plays is sampled, as then one wants to see those
 * frames.
 */
export function stopsOnFrame({ store, settings }: Uses<'store' | 'settings'>): boolean {
  return settings.get().timeDisplay === 'frames' || playsSamples(store.document);
}

/** Stops playback before a key is made at the current time. If paused, the time stays. */
export function pausePlayback(wb: Parts): void {
  const onFrame = wb.timeline.view.get().snapsToFrames || stopsOnFrame(wb);
  wb.transport.update((now) => (now.playing ? pause(now, onFrame) : now));
}
