/** The playback range in words. */

import type { Uses } from '../../state/workbench.ts';
import { announce } from '../../widgets/announce.ts';
import { timeText } from '../timeline/time-menu.ts';

/** Says the range, which a key has changed. */
export function sayRange(wb: Uses<'transport' | 'settings'>): void {
  announce(rangeText(wb));
}

/** `Range 0 s to 2.5 s`. */
export function rangeText(wb: Uses<'transport' | 'settings'>): string {
  const [from, to] = wb.transport.get().range;
  return `Range ${timeText(wb, from)} to ${timeText(wb, to)}`;
}
