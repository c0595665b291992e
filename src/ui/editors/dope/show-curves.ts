/** From the dope sheet to the curve editor. */
import type { Workbench } from '../../state/workbench.ts';

/** The curve editor with these channels and no others. */
export function showCurves(wb: Workbench, channels: readonly number[]): void {
  const { isolated: _none, ...view } = wb.timeline.view.get();
  wb.timeline.view.set({ ...view, tab: 'curves', list: 'pinned', pinned: [...channels], hidden: [], filter: '' });
}
