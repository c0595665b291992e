/** The dope sheet. */
import { element } from '../dom.ts';
import type { TimelineTab } from '../timeline/timeline.ts';
import type { Workbench } from '../workbench.ts';

export function dopePanel(_wb: Workbench): TimelineTab {
  return { element: element('div', { class: 'dope' }), setVisible() {}, fitAll() {}, fitSelected() {}, recolour() {} };
}
