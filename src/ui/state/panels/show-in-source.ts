/** How other panels show a place in the text of a file. */

import type { SourcePlace } from '../source.ts';
import type { Uses } from '../workbench.ts';
import { openPanel } from './panels.ts';

/** Shows a line of a file in the tab *Source*. */
export function showInSource(wb: Uses<'timeline' | 'settings'>, place: SourcePlace): void {
  openPanel(wb, 'timeline', true);
  wb.timeline.sourceAsked.set(place);
  wb.timeline.change({ tab: 'source' });
}
