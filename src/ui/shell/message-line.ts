/**
 * The newest unread message, as a line at the bottom of the viewport. It stays until dismissed, a refusal until the
 * next step (`stale-messages.ts`); only a confirmation disappears by itself, unless there is something to do about it.
 */
import type { Diagnostic } from '../../model/diagnostic.ts';
import { type Message, mainProblem } from '../state/messages.ts';
import { offerButton } from '../state/offer-button.ts';
import { showInSource } from '../state/panels/show-in-source.ts';
import type { Uses } from '../state/workbench.ts';
import { button, element, write } from '../widgets/dom.ts';
import { icon } from '../widgets/icons.ts';
import { plural } from '../widgets/numbers/number-text.ts';
import { PassingTime } from '../widgets/passing-time.ts';

const PASSING_MS = 10_000;

export function messageLine(wb: Uses<'messages' | 'timeline' | 'settings'>): HTMLElement {
  const { messages } = wb;
  // Assertive errors would need a second region; a line that stays can wait until the reader has finished.
  const region = element('div', { class: 'message-line', role: 'status', 'aria-live': 'polite' });
  const show = () => {
    const unread = messages.list.get().filter((m) => m.unread);
    const passing = messages.passing.get();
    const first = unread.at(-1);
    write(region, 'hidden', first === undefined && passing === undefined);
    if (passing !== undefined) {
      write(region, 'className', 'message-line severity-info');
      region.replaceChildren(
        icon('info'),
        element('span', { class: 'message-text' }, passing),
        ...messages.offers.map(offerButton),
        button('Dismiss', { class: 'tool small' }, icon('close'), () => messages.passing.set(undefined)),
      );
      return;
    }
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
    // The one whose line the text names.
    const place = placedIn(first);
    const more = others > 0 ? `${plural(others, 'more message')}` : 'Details';
    write(region, 'className', `message-line severity-${first.severity}`);
    region.replaceChildren(
      icon(first.severity),
      element('span', { class: 'message-text', tooltip: first.text }, first.text),
      place
        ? button(`Show line ${place.line} of ${place.file} in Source`, { class: 'link' }, `Line ${place.line}`, () =>
            showInSource(wb, place),
          )
        : '',
      ...(first.offers ?? []).map(offerButton),
      listed ? button(more, { class: 'link', tooltip: 'Show all messages' }, more, showAll) : '',
      button('Dismiss', { class: 'tool small' }, icon('close'), () => messages.markAllRead()),
    );
  };
  messages.list.subscribe(show);
  const time = new PassingTime(PASSING_MS, () => messages.passing.set(undefined));
  messages.passing.subscribe((text) => {
    if (text === undefined || messages.lasts) time.end();
    else time.begin();
    show();
  });
  // Who reaches for it, by mouse or keyboard, finds it there.
  let hasPointer = false;
  const hold = () => time.hold(hasPointer || region.contains(document.activeElement));
  for (const [type, has] of [
    ['pointerenter', true],
    ['pointerleave', false],
  ] as const) {
    region.addEventListener(type, () => {
      hasPointer = has;
      hold();
    });
  }
  region.addEventListener('focusin', hold);
  // The focus has left by then.
  region.addEventListener('focusout', () => queueMicrotask(hold));
  show();
  return region;
}

/** The problem that a message's text tells, if it has a line. */
function placedIn({ diagnostics }: Message): Diagnostic | undefined {
  const told = mainProblem(diagnostics);
  return told && told.line > 0 && told.file !== '' ? told : undefined;
}
