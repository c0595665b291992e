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
 * Whether pausing goes to the nearest frame. It rests on the time shown, to look at it: in seconds that may be any. Where
 * frames are counted and snapped to, as in Maya and Blender, a pause between two of them would show a pose that no frame
 * has, and from which the next step is no whole frame; and of samples one wants to see those that were captured.
 */
export function stopsOnFrame({ store, settings, timeline }: Uses<'store' | 'settings' | 'timeline'>): boolean {
  const snapsFrames = settings.get().timeDisplay === 'frames' && timeline.view.get().snapsToFrames;
  return snapsFrames || playsSamples(store.document);
}

/** Stops playback before a key is made at the current time. If paused, the time stays. */
export function pausePlayback(wb: Parts): void {
  const onFrame = wb.timeline.view.get().snapsToFrames || stopsOnFrame(wb);
  wb.transport.update((now) => (now.playing ? pause(now, onFrame) : now));
}
