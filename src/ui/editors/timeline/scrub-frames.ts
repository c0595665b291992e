import type { Uses } from '../../state/workbench.ts';

/**
 * Frame rate that a scrubbed time snaps to, in the scrubber and all rulers: if *Snap to frames* is on, or with Shift if
 * it is off; undefined for none.
 */
export function scrubFrames(wb: Uses<'transport' | 'timeline'>, shift: boolean): number | undefined {
  return wb.timeline.view.get().snapsToFrames !== shift ? wb.transport.get().framesPerSecond : undefined;
}
