/**
 * Pausing and keying during playback. A key press falls between two frames: a pause there would show a pose that no
 * frame has, from which the next step is no whole frame, and a key there would be at a time that no frame shows. So
 * playback stops on the nearest frame, as in Maya and Blender. What is shown then is what is keyed. (Continuing
 * playback and keying the nearest frame would key another pose than the one on screen.)
 */
import { playsFrames } from '../../edit/frame-rate.ts';
import { pause } from '../../edit/playback.ts';
import type { Uses, Workbench } from './workbench.ts';

type Parts = Pick<Workbench, 'store' | 'transport' | 'timeline'>;

/**
 * Whether pausing goes to the nearest frame: if a take has frames, or if times snap to frames, as when scrubbing.
 * Otherwise it rests at the exact time.
 */
export function stopsOnFrame({ store, timeline }: Uses<'store' | 'timeline'>): boolean {
  return timeline.view.get().snapsToFrames || playsFrames(store.document);
}

/** Stops playback before a key is made at the current time. If paused, the time stays. */
export function pausePlayback(wb: Parts): void {
  wb.transport.update((now) => (now.playing ? pause(now, stopsOnFrame(wb)) : now));
}
