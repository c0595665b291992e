/** A card in the middle of the viewport while nothing is open: what to open, and how. */

import { tryById } from '../../state/actions/action.ts';
import { menuEntries } from '../../state/actions/menu-entries.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { menuButton } from '../../widgets/menu.ts';

export function emptyStage(wb: Uses<'store' | 'actions' | 'settings' | 'loading' | 'timeline'>): HTMLElement {
  const run = (id: string) => () => tryById(wb, id);
  const open = button('Open files…', { class: 'plain primary' }, 'Open files…', run('file.open'));
  setActionTooltip(wb, open, 'file.open', 'Open files…');
  const examples = button('Examples', { class: 'plain' }, 'Examples', () => {});
  examples.append(icon('fold'));
  menuButton(examples, 'Examples', () => menuEntries(wb, 'Examples'));
  const start = button('New skeleton', { class: 'plain' }, 'New skeleton', run('rigging.new'));
  setActionTooltip(wb, start, 'rigging.new', 'New skeleton');
  const card = element(
    'section',
    { class: 'empty-stage', 'aria-label': 'Nothing is open' },
    element('h2', {}, 'Nothing is open'),
    element('p', {}, 'Open a character to see it move, pose it and key it.'),
    element('div', { class: 'empty-stage-buttons' }, open, examples, start),
    element(
      'p',
      { class: 'faint' },
      'Or drop files here: .skel .skin .morph .anim .bvh .pose .rig, a folder or a zip.',
    ),
  );
  const show = () => {
    // Open, or about to be.
    const isReviewing = wb.timeline.review.shown.get() !== undefined || wb.store.document.review !== undefined;
    write(card, 'hidden', wb.store.document.characters.length > 0 || wb.loading.get() !== undefined || isReviewing);
  };
  wb.timeline.review.shown.subscribe(show);
  wb.store.subscribe(show);
  wb.loading.subscribe(show);
  show();
  return card;
}
