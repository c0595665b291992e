/** Sentences for screen readers only, about what is otherwise seen: a number that was copied. */
import { cutMessage } from '../../model/names/cut-text.ts';
import { element } from './dom.ts';

let region: HTMLElement | undefined;

/** Says it, also if it is the same again. */
export function announce(said: string): void {
  const text = cutMessage(said);
  // Tests of actions have no page.
  if (typeof document === 'undefined') return;
  if (!region?.isConnected) {
    region = element('div', { class: 'off-screen', role: 'status' });
    document.body.append(region);
  }
  // The same text again would be no change.
  region.textContent = region.textContent === text ? `${text}\u00a0` : text;
}
