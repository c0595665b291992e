/** From the dope sheet to the curve editor. */
import type { Uses } from '../../state/workbench.ts';

/** The curve editor with these channels and no others. */
export function showCurves(wb: Uses<'timeline'>, channels: readonly number[]): void {
  const { isolated: _none, ...view } = wb.timeline.view.get();
  wb.timeline.view.set({ ...view, tab: 'curves', list: 'pinned', pinned: [...channels], hidden: [], filter: '' });
}
