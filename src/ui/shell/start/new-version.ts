/** Offers a new version of the page, as a line at the bottom of the viewport: nothing is reloaded unasked. */

import type { Uses } from '../../state/workbench.ts';
import { button, element, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';

export function newVersion(wb: Uses<'offline' | 'files'>): HTMLElement {
  const line = element('section', { class: 'offer', 'aria-label': 'New version' });
  // Announced when it appears.
  const text = element('span', { class: 'offer-text', role: 'status' });
  const show = () => {
    const offer = wb.offline.get().newVersion;
    const isShown = offer !== undefined && !offer.isPutOff;
    write(line, 'hidden', !isShown);
    text.textContent = isShown ? sentence(wb.files.unsaved.get().length > 0) : '';
    if (!isShown) return line.replaceChildren(text);
    line.replaceChildren(
      text,
      button('Reload', { class: 'offer-accept' }, 'Reload', () => offer.reload()),
      button('Not now. Also in the Help menu', { class: 'tool small' }, icon('close'), () => offer.later()),
    );
  };
  wb.offline.subscribe((now, before) => {
    if (now.newVersion !== before.newVersion) show();
  });
  wb.files.unsaved.subscribe(show);
  show();
  return line;
}

function sentence(hasUnsaved: boolean): string {
  return `A new version of Marrow is ready.${hasUnsaved ? ' Unsaved changes can be restored after reloading.' : ''}`;
}
