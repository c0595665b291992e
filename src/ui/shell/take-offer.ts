/** Offers a first take at the foot of the viewport, while there is none and so nothing is below the viewport. */

import { currentCharacter, tryById } from '../state/actions/action.ts';
import { isBarShown } from '../state/panels/panels.ts';
import type { Uses } from '../state/workbench.ts';
import { button, element, write } from '../widgets/dom.ts';

export function takeOffer(wb: Uses<'store' | 'actions' | 'settings' | 'posing' | 'comparing'>): HTMLElement {
  const offer = element(
    'section',
    { class: 'offer', 'aria-label': 'Take' },
    element('span', { class: 'offer-text' }, 'No take. Drop an .anim or .bvh file, or start one.'),
    button('New take', { class: 'offer-accept' }, 'New take', () => tryById(wb, 'take.new')),
  );
  const show = () => {
    // Whoever compares wants to know what is wrong first.
    const isElsewhere = wb.posing.mode.get() === 'rig' || wb.comparing.get() !== undefined;
    write(offer, 'hidden', isElsewhere || isBarShown(wb) || !currentCharacter(wb)?.skeleton);
  };
  wb.store.subscribe((now, before) => {
    if (now !== before) show();
  });
  wb.settings.subscribe((now, before) => {
    if (now.panels !== before.panels) show();
  });
  wb.posing.mode.subscribe(show);
  wb.comparing.subscribe(show);
  show();
  return offer;
}
