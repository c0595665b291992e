/**
 * Native selects open the page's own menu instead of the browser's list: one look, one behaviour. To labels, scripts
 * and screen readers a select stays what it is; arrows and letters choose in it without a menu, as always.
 */
import { isTextField, leaveField } from './focus/focus.ts';
import { type Menu, openMenu } from './menu.ts';

/** Until aborted, for all selects of the page. */
export function openSelectsAsMenus(signal: AbortSignal): void {
  const options = { capture: true, signal };
  let shown: { readonly select: HTMLSelectElement; readonly menu: Menu } | undefined;
  const show = (select: HTMLSelectElement, byKeyboard: boolean) => {
    const menu = openMenu(select.getBoundingClientRect(), entriesOf(select), {
      label: select.ariaLabel ?? select.labels[0]?.textContent ?? '',
      opener: select,
      opensByClick: true,
      focusFirst: byKeyboard,
      startAt: select.selectedIndex,
      minWidth: select.offsetWidth,
      onClose() {
        shown = undefined;
      },
    });
    shown = { select, menu };
  };
  window.addEventListener(
    'mousedown',
    (event) => {
      const select = selectAt(event.target);
      if (!select || event.button !== 0) return;
      event.preventDefault();
      // As with other buttons, the focus stays elsewhere, but an edited field is done.
      const { activeElement } = document;
      if (isTextField(activeElement)) leaveField(activeElement, select);
      if (shown?.select === select) shown.menu.close(true);
      else show(select, false);
    },
    options,
  );
  window.addEventListener(
    'keydown',
    (event) => {
      const select = selectAt(event.target);
      if (!select || event.ctrlKey || event.metaKey) return;
      const isArrow = event.key === 'ArrowDown' || event.key === 'ArrowUp';
      const opens = event.altKey ? isArrow : event.key === ' ' || event.key === 'Enter' || event.key === 'F4';
      if (!opens) return;
      event.preventDefault();
      event.stopPropagation();
      show(select, true);
    },
    options,
  );
}

function selectAt(target: EventTarget | null): HTMLSelectElement | undefined {
  return target instanceof HTMLSelectElement && !target.disabled ? target : undefined;
}

function entriesOf(select: HTMLSelectElement) {
  return [...select.options].map((option, index) => ({
    kind: 'item' as const,
    label: option.label,
    radio: true,
    checked: index === select.selectedIndex,
    enabled: !option.disabled,
    run() {
      if (index === select.selectedIndex) return;
      select.selectedIndex = index;
      for (const type of ['input', 'change']) select.dispatchEvent(new Event(type, { bubbles: true }));
    },
  }));
}
