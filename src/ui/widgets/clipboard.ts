import { element } from './dom.ts';

/** What is said where nothing could be copied. */
export const BLOCKED = 'The browser blocked copying.';

/** Copies text. Returns false if the browser doesn’t let it. Browsers allow the clipboard API over https only. */
export async function copyText(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return copyBySelection(text);
  }
}

/** The method from before the clipboard API; still the only one over plain http. */
function copyBySelection(text: string): boolean {
  const area = element('textarea', { class: 'off-screen' });
  area.value = text;
  const focused = document.activeElement;
  // All else is inert beside a modal dialog.
  (focused?.closest('dialog') ?? document.body).append(area);
  area.select();
  const done = document.execCommand('copy');
  area.remove();
  if (focused instanceof HTMLElement) focused.focus();
  return done;
}
