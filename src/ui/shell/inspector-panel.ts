/** The right panel, in place from the start; its content is loaded after the first frame, playing or not. */

import { afterFrame, onDemand } from '../state/on-demand.ts';
import type { Workbench } from '../state/workbench.ts';
import { element } from '../widgets/dom.ts';

export function inspectorPanel(wb: Workbench): HTMLElement {
  const panel = element('section', { class: 'panel inspector', 'aria-label': 'Inspector', 'data-panel': 'inspector' });
  afterFrame(wb, async () => {
    const module = await onDemand(wb.messages, 'The inspector', () => import('../editors/inspector/inspector.ts'));
    module?.fillInspector(wb, panel);
  });
  return panel;
}
