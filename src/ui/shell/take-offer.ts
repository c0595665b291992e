/** Offers a first take at the foot of the viewport, while there is none. */

import { currentCharacter, tryById } from '../state/actions/action.ts';
import { hasAnyTake } from '../state/panels/panels.ts';
import type { Uses } from '../state/workbench.ts';
import { button, element, write } from '../widgets/dom.ts';

export function takeOffer(wb: Uses<'store' | 'actions' | 'posing'>): HTMLElement {
  const offer = element(
    'section',
    { class: 'offer', 'aria-label': 'Take' },
    element('span', { class: 'offer-text' }, 'No take. Drop an .anim or .bvh file, or start one.'),
    button('New take', { class: 'offer-accept' }, 'New take', () => tryById(wb, 'take.new')),
  );
  const show = () => {
    const { document } = wb.store;
    const isRig = wb.posing.mode.get() === 'rig';
    write(offer, 'hidden', hasAnyTake(document) || !currentCharacter(wb)?.skeleton || isRig);
  };
  wb.store.subscribe((now, before) => {
    if (now !== before) show();
  });
  wb.posing.mode.subscribe(show);
  show();
  return offer;
}
