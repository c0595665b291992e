/** From the dope sheet to the curve editor. */
import type { Uses } from '../../state/workbench.ts';
import { isolateOfAll, setOfAll } from '../timeline/listed-of-all.ts';

/** Shows only these channels in the curve editor. */
export function showCurves(wb: Uses<'store' | 'timeline'>, channels: readonly number[]): void {
  isolateOfAll(wb, undefined);
  setOfAll(wb, 'hidden', []);
  setOfAll(wb, 'pinned', channels);
  wb.timeline.change({ tab: 'curves', list: 'pinned', filter: '' });
}
