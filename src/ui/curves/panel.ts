/** The curve editor. */
import { element } from '../dom.ts';
import type { TimelineTab } from '../timeline/timeline.ts';
import type { Workbench } from '../workbench.ts';

export function curvePanel(_wb: Workbench): TimelineTab {
  return {
    element: element('div', { class: 'curves' }),
    setVisible() {},
    fitAll() {},
    fitSelected() {},
    recolour() {},
  };
}
