/** From the dope sheet to the curve editor. */
import type { Uses } from '../../state/workbench.ts';

/** Shows only these channels in the curve editor. */
export function showCurves(wb: Uses<'timeline'>, channels: readonly number[]): void {
  const { isolated: _none, ...view } = wb.timeline.view.get();
  wb.timeline.view.set({ ...view, tab: 'curves', list: 'pinned', pinned: [...channels], hidden: [], filter: '' });
}
