/** Toolbars: one tab stop each, with arrow keys, Home and End between their buttons. */

const STEPS: Readonly<Record<string, number>> = { ArrowLeft: -1, ArrowRight: 1 };

/**
 * Makes an element with buttons a toolbar. Radio buttons in it have arrow keys of their own and are left out; so are
 * fields, in which arrow keys move the cursor.
 */
export function toolbar<T extends HTMLElement>(bar: T): T {
  bar.role = 'toolbar';
  let stop: HTMLButtonElement | undefined;
  const buttons = () => [...bar.querySelectorAll<HTMLButtonElement>('button:not([role=radio])')];
  const isUsable = (button: HTMLButtonElement) => !button.disabled && !button.closest('[hidden]');
  const show = () => {
    const all = buttons();
    if (!stop || !all.includes(stop) || !isUsable(stop)) stop = all.find(isUsable);
    for (const button of all) {
      const tabIndex = button === stop ? 0 : -1;
      if (button.tabIndex !== tabIndex) button.tabIndex = tabIndex;
    }
  };
  const moveTo = (button: HTMLButtonElement) => {
    stop = button;
    show();
  };
  bar.addEventListener('focusin', ({ target }) => {
    if (target instanceof HTMLButtonElement && buttons().includes(target)) moveTo(target);
  });
  bar.addEventListener('keydown', (event) => {
    const { key, target, defaultPrevented } = event;
    if (defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || event.shiftKey) return;
    if (!(target instanceof HTMLButtonElement)) return;
    const shown = buttons().filter((button) => isUsable(button) && button.getClientRects().length > 0);
    const from = shown.indexOf(target);
    if (from < 0) return;
    const step = STEPS[key];
    const to = step ? (from + step + shown.length) % shown.length : key === 'Home' ? 0 : key === 'End' ? -1 : undefined;
    if (to === undefined) return;
    event.preventDefault();
    shown.at(to)?.focus();
  });
  new MutationObserver(show).observe(bar, { subtree: true, childList: true, attributeFilter: ['disabled', 'hidden'] });
  show();
  return bar;
}
