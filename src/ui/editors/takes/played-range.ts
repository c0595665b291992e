/** The playback range after takes were shown, hidden or moved in time. */
import { sharedFrameRate } from '../../../edit/frame-rate.ts';
import { countedAt } from '../../../edit/playback.ts';
import { takesRange } from '../../../evaluate/plot/shown-keys.ts';
import type { Uses } from '../../state/workbench.ts';

/**
 * Plays the range from its start, without starting or stopping playback. The frame rate is that of what plays, if they
 * share one: frame 26 is the file's frame 26.
 */
export function playRange(wb: Uses<'store' | 'transport'>, range: readonly [number, number]): void {
  const rate = sharedFrameRate(wb.store.document);
  wb.transport.update((p) => countedAt({ ...p, range, timeSeconds: range[0], turned: false }, rate));
}

export function followRangeOfTakes(wb: Uses<'store' | 'transport'>): void {
  const range = takesRange(wb.store.document);
  if (range) wb.transport.update((p) => ({ ...p, range }));
}
