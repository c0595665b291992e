/** A flag in a list of flags, which leads to its moment. */
import type { Flag } from '../../../review/flags.ts';
import { element } from '../../widgets/dom.ts';
import { amountText, FLAG_NAMES, momentText } from './texts.ts';

export function flagItem(flag: Flag, seek: (flag: Flag) => void): HTMLElement {
  const joint = flag.joint ?? '';
  const what = element('span', { class: 'review-flag-what' }, FLAG_NAMES[flag.kind]);
  if (joint !== '') what.append(element('span', { class: 'faint' }, ` ${joint}`));
  const made = element(
    'button',
    {
      type: 'button',
      class: 'review-flag',
      tooltip: `${FLAG_NAMES[flag.kind]}${joint ? ` of ${joint}` : ''}: go to ${momentText(flag)}`,
    },
    what,
    // Spaces are for its name, which is its content.
    ' ',
    element('span', { class: 'number' }, amountText(flag)),
    ' ',
    element('span', { class: 'number' }, momentText(flag)),
  );
  made.addEventListener('click', () => seek(flag));
  return element('li', {}, made);
}
