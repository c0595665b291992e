/**
 * Offers to restore work from a page that was closed, crashed or reloaded, as a line at the bottom of the viewport:
 * never automatically, and not as a dialog, so as not to interrupt. Once something else is being worked on it shrinks,
 * and stays until answered.
 */

import type { KeptOffer, KeptWork } from '../../state/kept-offer.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { menuButton } from '../../widgets/menu.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { contentText, whenText } from './kept-text.ts';

export function keptSession(wb: Uses<'kept'>): HTMLElement {
  const line = element('section', { class: 'offer', 'aria-label': 'Unsaved work' });
  // Announced when it appears; the buttons outside aren't read again with each change.
  const text = element('span', { class: 'offer-text', role: 'status' });
  const show = () => {
    const offer = wb.kept.get();
    const isShown = offer !== undefined && !offer.isPutOff;
    write(line, 'hidden', !isShown);
    if (!isShown) {
      line.replaceChildren(text);
      text.textContent = '';
      return;
    }
    const [work, ...others] = offer.works;
    line.classList.toggle('small', offer.isAside);
    const close = button(
      'Not now. Offered again next time and in the Open menu',
      { class: 'tool small' },
      icon('close'),
      offer.later,
    );
    if (offer.discarded) {
      text.textContent = `Unsaved work from ${whenText(offer.discarded.savedAtMs)} was discarded.`;
      const back = button('Keep it', { class: 'link' }, 'Keep it', offer.putBack);
      line.replaceChildren(text, back, close);
      return;
    }
    if (!work) {
      write(line, 'hidden', true);
      return;
    }
    const when = whenText(work.savedAtMs);
    text.textContent = offer.isAside
      ? `Work from ${when}`
      : `Unsaved work from ${when}: ${contentText(work.characters)}.`;
    setTooltip(text, contentText(work.characters));
    const restoring = offer.isAside ? 'Restore. Replaces what is open; Undo brings it back' : 'Restore';
    line.replaceChildren(
      text,
      button(restoring, { class: 'offer-accept' }, 'Restore', () => offer.restore(work.id)),
      button('Discard', { class: 'link' }, 'Discard', () => offer.discard(work.id)),
      others.length > 0 && !offer.isAside ? olderButton(offer, others) : '',
      close,
    );
    if (offer.isAskedFor) line.querySelector<HTMLElement>('.offer-accept')?.focus();
  };
  wb.kept.subscribe(show);
  show();
  return line;
}

/** `2 older`: opens a list of them. */
function olderButton(offer: KeptOffer, others: readonly KeptWork[]): HTMLElement {
  const label = `${others.length} older`;
  const made = element('button', { type: 'button', class: 'link' }, label);
  menuButton(made, label, () =>
    others.map(({ id, savedAtMs, characters }) => ({
      kind: 'item',
      label: whenText(savedAtMs),
      detail: contentText(characters),
      enabled: true,
      run: () => offer.choose(id),
    })),
  );
  return made;
}
