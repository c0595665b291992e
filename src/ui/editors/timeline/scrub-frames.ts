import type { Uses } from '../../state/workbench.ts';

/**
 * Frame rate that a scrubbed time snaps to; undefined for none.
 *
 * @param free Shift is held
 */
export function scrubFrames(wb: Uses<'transport' | 'timeline' | 'settings'>, free: boolean): number | undefined {
  const snaps = wb.settings.get().timeDisplay === 'frames' || wb.timeline.view.get().snapsToFrames;
  return snaps && !free ? wb.transport.get().framesPerSecond : undefined;
}
