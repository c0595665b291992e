/**
 * What was not finished when a page was closed, crashed or reloaded, as a line over the viewport's foot: offered, never
 * restored by itself, and no dialog, since whoever came for something else should get on with it. Once something else
 * is worked on it shrinks, and stays until it is answered.
 */
import { button, element } from './dom.ts';
import { icon } from './icons.ts';
import type { KeptOffer, KeptWork } from './kept-offer.ts';
import { menuButton } from './menu.ts';
import { plural } from './number-text.ts';
import type { Workbench } from './workbench.ts';

export function keptSession(wb: Workbench): HTMLElement {
  const line = element('section', { class: 'kept-session', 'aria-label': 'Work that was not finished' });
  // Told when it appears; the buttons outside of it are not read out again with each change.
  const text = element('span', { class: 'kept-text', role: 'status' });
  const show = () => {
    const offer = wb.kept.get();
    line.hidden = offer === undefined;
    if (!offer) {
      line.replaceChildren(text);
      text.textContent = '';
      return;
    }
    const [work, ...others] = offer.works;
    line.classList.toggle('small', offer.isAside);
    const close = button('Not now: offered again next time', { class: 'tool small' }, icon('close'), offer.later);
    if (offer.discarded) {
      text.textContent = `Your work of ${whenText(offer.discarded.savedAtMs)} is discarded.`;
      const back = button('Keep it after all', { class: 'link' }, 'Keep it after all', offer.putBack);
      line.replaceChildren(text, back, close);
      return;
    }
    if (!work) {
      line.hidden = true;
      return;
    }
    const when = whenText(work.savedAtMs);
    text.textContent = offer.isAside
      ? `Work of ${when}`
      : `Your work of ${when} is still here: ${contentText(work.characters)}.`;
    text.title = contentText(work.characters);
    const restoring = offer.isAside ? 'Restore: takes the place of what is open; undo brings that back' : 'Restore';
    line.replaceChildren(
      text,
      button(restoring, { class: 'kept-restore' }, 'Restore', () => offer.restore(work.id)),
      button('Discard', { class: 'link' }, 'Discard', () => offer.discard(work.id)),
      others.length > 0 && !offer.isAside ? olderButton(offer, others) : '',
      close,
    );
  };
  wb.kept.subscribe(show);
  show();
  return line;
}

/** `2 older`: a list of them. */
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

/** `14:32`, `yesterday, 14:32`, `3 March, 14:32`; in the manner of the browser's language, for it is a clock. */
export function whenText(atMs: number, now = new Date()): string {
  const at = new Date(atMs);
  const time = at.toLocaleTimeString([], { hour: '2-digit', minute: '2-digit' });
  if (at.toDateString() === now.toDateString()) return time;
  const dayBefore = new Date(now.getFullYear(), now.getMonth(), now.getDate() - 1);
  if (at.toDateString() === dayBefore.toDateString()) return `yesterday, ${time}`;
  return `${at.toLocaleDateString('en-GB', { day: 'numeric', month: 'long' })}, ${time}`;
}

/** `wasp, 31 joints, 2 clips`; of several characters the names. */
export function contentText(characters: KeptWork['characters']): string {
  const [first] = characters;
  if (!first) return 'files without a character';
  if (characters.length > 1) {
    const others = characters.length - 2;
    const names = `${first.name}, ${characters[1].name}`;
    return others > 0 ? `${names} and ${plural(others, 'more character')}` : names.replace(', ', ' and ');
  }
  const parts = [first.name || 'a character without a name'];
  if (first.joints > 0) parts.push(plural(first.joints, 'joint'));
  if (first.clips > 0) parts.push(plural(first.clips, 'clip'));
  return parts.join(', ');
}
