/** Ctrl+V while *Compare* is shown: the numbers that were copied are compared, wherever the focus is but in a field. */

import { shortcutsOf } from '../../state/shortcuts.ts';
import type { Uses } from '../../state/workbench.ts';
import { isTextField } from '../../widgets/focus/focus.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { compareText } from './start.ts';

/** Listens until aborted. */
export function listenToPaste(wb: Uses<'files' | 'messages'>, signal: AbortSignal): void {
  const options = { capture: true, signal };
  // The timeline's own key would paste keys of curves, which this tab doesn't show, and the browser would say nothing.
  window.addEventListener(
    'keydown',
    (event) => {
      if (shortcutsOf(event, isMac).includes('Ctrl+V') && isFree(event)) event.stopPropagation();
    },
    options,
  );
  window.addEventListener(
    'paste',
    (event) => {
      const text = event.clipboardData?.getData('text/plain') ?? '';
      // Copied files are opened as dropped ones are.
      if (text.trim() === '' || event.clipboardData?.files.length || !isFree(event)) return;
      event.preventDefault();
      event.stopPropagation();
      if (hasNumbers(text)) compareText(wb, text);
      else wb.messages.note('Expected numbers to compare on the clipboard, found other text.', 'warning');
    },
    options,
  );
}

/** Whether no field, menu or dialog has the event. */
function isFree({ target }: Event): boolean {
  const at = target instanceof Element ? target : null;
  return !isTextField(at) && !at?.closest('[role=menu],dialog');
}

/** Whether text has at least a point's: three numbers that aren't parts of names. */
function hasNumbers(text: string): boolean {
  return (text.match(/(?<![\w.])[-+]?\.?\d/g)?.length ?? 0) >= 3;
}
