/** Actions on a comparison with dumps. */
import { needs } from '../../state/actions/needs.ts';
import { openPanel } from '../../state/panels/panels.ts';
import { endComparison } from '../../state/shown-comparison.ts';
import type { Action } from '../../state/workbench.ts';

const NO_DUMP = 'Nothing is compared. Drop the numbers that your program printed.';

export const COMPARE_ACTIONS: readonly Action[] = [
  {
    id: 'compare.paste',
    label: 'Compare with your program…',
    detail: 'Finds where your numbers are wrong, and why',
    group: 'Files',
    menu: 'Open',
    section: 2,
    also: 'dump numbers matrices vertices debug check homework mistake error paste',
    run(wb) {
      openPanel(wb, 'timeline', true);
      wb.timeline.change({ tab: 'compare' });
    },
  },
  {
    id: 'compare.stop',
    label: 'Stop comparing with your program',
    group: 'Files',
    menu: 'Open',
    section: 2,
    also: 'dump close end',
    refuses: needs(NO_DUMP, (wb) => wb.comparing.get() !== undefined),
    run: (wb) => endComparison(wb),
  },
];
