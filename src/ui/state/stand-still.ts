/**
 * Keys made while something plays. The moment of a key press lies anywhere between two frames, and a key there is one
 * that no frame shows and that is never met again. So playing stops there, as one does by hand before keying: on the
 * nearest frame, or where nothing is counted in frames at the very moment. What one sees then is what is keyed, under the
 * playhead. (To go on playing and key the nearest frame unseen would key another pose than the one on the screen.)
 */
import { playsSamples } from '../../edit/frame-rate.ts';
import { pause } from '../../edit/playback.ts';
import type { Uses, Workbench } from './workbench.ts';

type Parts = Pick<Workbench, 'store' | 'transport' | 'timeline' | 'settings'>;

/**
 * Whether what is paused stops on a frame: where one counts in frames, or what plays is frames of a file, for then it is
 * these that one wants to look at.
 */
export function stopsOnFrame({ store, settings }: Uses<'store' | 'settings'>): boolean {
  return settings.get().timeDisplay === 'frames' || playsSamples(store.document);
}

/** Stops what plays, before a key is made at the moment shown. What stands still stays where it is. */
export function standStill(wb: Parts): void {
  const onFrame = wb.timeline.view.get().snapsToFrames || stopsOnFrame(wb);
  wb.transport.update((now) => (now.playing ? pause(now, onFrame) : now));
}
