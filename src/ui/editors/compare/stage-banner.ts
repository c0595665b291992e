/** The place of the banner over the viewport; its script is loaded with the first comparison. */

import { onDemand } from '../../state/on-demand.ts';
import type { Workbench } from '../../state/workbench.ts';
import { element } from '../../widgets/dom.ts';

export function stageBanner(wb: Workbench): HTMLElement {
  const banner = element('section', { class: 'offer compare-banner', 'aria-label': 'Comparison', hidden: true });
  const stop = wb.comparing.subscribe(async () => {
    stop();
    const module = await onDemand(wb.messages, 'The comparison', () => import('./banner.ts'));
    module?.fillBanner(wb, banner);
  });
  return banner;
}
