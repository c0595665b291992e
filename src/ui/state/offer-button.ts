import { button } from '../widgets/dom.ts';
import type { Offer } from './messages.ts';

/** What a message offers, as it is in the line and in the list. */
export function offerButton({ label, run }: Offer): HTMLButtonElement {
  return button(label, { class: 'link' }, label, () => run());
}
