/** A flag in a list of flags, which leads to its moment. */
import type { Flag } from '../../../review/flags.ts';
import { button, element } from '../../kit/dom.ts';
import { amountText, FLAG_NAMES, momentText } from './texts.ts';

export function flagItem(flag: Flag, seek: (flag: Flag) => void): HTMLElement {
  const joint = flag.joint ?? '';
  const text = `${FLAG_NAMES[flag.kind]}${joint ? ` of ${joint}` : ''}`;
  const made = button(
    `${text}, ${momentText(flag)}, ${amountText(flag)}`,
    { class: 'review-flag', tooltip: `${text}: go to ${momentText(flag)}` },
    element(
      'span',
      { class: 'review-flag-what' },
      FLAG_NAMES[flag.kind],
      joint !== '' && element('span', { class: 'faint' }, ` ${joint}`),
    ),
    () => seek(flag),
  );
  made.append(
    element('span', { class: 'number' }, amountText(flag)),
    element('span', { class: 'number' }, momentText(flag)),
  );
  return element('li', {}, made);
}
