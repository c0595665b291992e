/** The curve editor: channels on the left, the plot beside them, its buttons above the ruler. */

import { onDemand } from '../../state/on-demand.ts';
import type { TimelineTab } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { element } from '../../widgets/dom.ts';
import { ChannelList } from './channel-list.ts';
import { CurvePlot } from './plot.ts';
import { curveToolbar } from './toolbar.ts';
import type { WhyPane } from './why/why-pane.ts';

export function curvePanel(
  wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages' | 'comparing'>,
): TimelineTab {
  const plot = new CurvePlot(wb);
  const list = new ChannelList(wb, plot.source);
  const panel = element('div', { class: 'curves' }, list.element, plot.element);
  showWhyBeside(wb, panel, plot);
  return {
    element: panel,
    tools: curveToolbar(wb),
    names: list.head,
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

/** *Why this curve*, loaded when it is first shown. */
function showWhyBeside(wb: Uses<'store' | 'timeline' | 'settings' | 'messages'>, panel: HTMLElement, plot: CurvePlot) {
  let pane: WhyPane | undefined;
  const show = async () => {
    if (wb.timeline.view.get().showsWhy && !pane) {
      const module = await onDemand(wb.messages, 'Why this curve', () => import('./why/why-pane.ts'));
      pane ??= module && new module.WhyPane(wb);
    }
    const own = pane;
    const isShown = own !== undefined && wb.timeline.view.get().showsWhy;
    panel.classList.toggle('with-why', isShown);
    if (isShown) panel.append(own.element);
    else own?.element.remove();
    plot.afterDraw = isShown ? () => own.show(plot.whyPlace()) : undefined;
    plot.drawSoon();
  };
  wb.timeline.view.subscribe((now, before) => {
    if (now.showsWhy !== before.showsWhy) void show();
  });
  void show();
}
