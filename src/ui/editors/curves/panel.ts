/** The curve editor: channels on the left, the plot beside them, its buttons in the row of tabs. */
import { element } from '../../kit/dom.ts';
import type { TimelineTab } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { ChannelList } from './channel-list.ts';
import { CurvePlot } from './plot.ts';
import { curveToolbar } from './toolbar.ts';

export function curvePanel(
  wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages'>,
): TimelineTab {
  const plot = new CurvePlot(wb);
  const list = new ChannelList(wb, plot.source);
  return {
    element: element('div', { class: 'curves' }, list.element, plot.element),
    tools: curveToolbar(wb),
    setVisible(visible) {
      plot.setVisible(visible);
      list.setVisible(visible);
    },
    fitAll: () => plot.fitAll(),
    fitSelected: () => plot.fitSelected(),
    zoom: (time, value) => plot.zoom(time, value),
    pan: (time, value) => plot.pan(time, value),
    placeOf: (channel, timeSeconds, value) => plot.placeOf(channel, timeSeconds, value),
    recolour: () => plot.recolour(),
  };
}
