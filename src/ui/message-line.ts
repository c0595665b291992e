/** The worst message that nobody has read, as a line over the viewport's foot. It stays until it is put away. */
import { button, element } from './dom.ts';
import { icon } from './icons.ts';
import type { Message } from './messages.ts';
import { plural } from './number-text.ts';
import type { Workbench } from './workbench.ts';

export function messageLine(wb: Workbench): HTMLElement {
  const { messages } = wb;
  // Assertive for errors would need a second region; a line that stays can wait for the reader to finish.
  const region = element('div', { class: 'message-line', role: 'status', 'aria-live': 'polite' });
  const show = () => {
    const unread = messages.list.get().filter((m) => m.unread);
    const first = mostUrgent(unread);
    region.hidden = first === undefined;
    if (!first) {
      region.replaceChildren();
      return;
    }
    const others = unread.length - 1;
    const showAll = () => {
      messages.markAllRead();
      messages.askForList();
    };
    const listed = others > 0 || first.diagnostics.length > 0;
    const more = others > 0 ? `${plural(others, 'more message')}` : 'Details';
    region.className = `message-line severity-${first.severity}`;
    region.replaceChildren(
      icon(first.severity),
      element('span', { class: 'message-text', title: first.text }, first.text),
      listed ? button('Show all messages', { class: 'link' }, more, showAll) : '',
      button('Dismiss', { class: 'tool small' }, icon('close'), () => messages.markAllRead()),
    );
  };
  messages.list.subscribe(show);
  show();
  return region;
}

/** Errors before warnings before notes; of equals the newest. */
function mostUrgent(messages: readonly Message[]): Message | undefined {
  for (const severity of ['error', 'warning', 'info'] as const) {
    const found = messages.findLast((m) => m.severity === severity);
    if (found) return found;
  }
  return undefined;
}
