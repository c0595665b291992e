/** Keys pressed while the script of a dialog loads are meant for the dialog: no panel and no shortcut may act on them. */
import { isTextField } from '../../widgets/focus/focus.ts';
import { passes } from '../../widgets/focus/typing.ts';

/**
 * Keeps all pressed keys from the page until `signal` is aborted. Escape isn't kept.
 *
 * @param cancel on Escape
 * @returns the kept keys, for `replayKeys`
 */
export function keepKeys(signal: AbortSignal, cancel: () => void): readonly KeyboardEvent[] {
  const kept: KeyboardEvent[] = [];
  const keep = (event: KeyboardEvent) => {
    if (event.isComposing) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    if (event.key === 'Escape') cancel();
    // The key that opened the dialog may still be held.
    else if (!event.repeat) kept.push(event);
  };
  window.addEventListener('keydown', keep, { capture: true, signal });
  return kept;
}

/** Types the kept keys into the focused element, as long as it is in `dialog`. */
export function replayKeys(kept: readonly KeyboardEvent[], dialog: HTMLElement): void {
  for (const event of kept) {
    const { activeElement } = document;
    if (!activeElement || !dialog.contains(activeElement)) return;
    const text = passes(activeElement, event) ? undefined : typedText(event);
    if (text === undefined) activeElement.dispatchEvent(new KeyboardEvent(event.type, event));
    else if (activeElement instanceof HTMLInputElement && isTextField(activeElement)) typeInto(activeElement, text);
  }
}

/** The typed character, empty for Backspace; undefined for other keys. */
function typedText(event: KeyboardEvent): string | undefined {
  const { key, ctrlKey, metaKey, altKey } = event;
  // AltGr types characters, and browsers report it as Ctrl+Alt.
  if (metaKey || (ctrlKey && !altKey)) return undefined;
  if (key === 'Backspace') return '';
  return [...key].length === 1 ? key : undefined;
}

function typeInto(field: HTMLInputElement, text: string): void {
  const end = field.selectionEnd ?? field.value.length;
  const start = field.selectionStart ?? end;
  const from = text === '' && start === end ? Math.max(0, start - 1) : start;
  field.setRangeText(text, from, end, 'end');
  field.dispatchEvent(new InputEvent('input', { bubbles: true }));
}
