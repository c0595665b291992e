/** The whole page accepts files: dropped anywhere, or pasted. Reading them is done elsewhere. */

import type { Uses } from '../../state/workbench.ts';
import { element, write } from '../../widgets/dom.ts';

export function dropTarget(wb: Uses<'files'>, signal: AbortSignal): HTMLElement {
  const veil = element(
    'div',
    { class: 'drop-veil', hidden: true, 'aria-hidden': 'true' },
    element('p', {}, 'Drop to open'),
  );
  const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
  // Every element under the pointer is entered and left: only their count shows when the page is left.
  let inside = 0;
  const show = () => {
    write(veil, 'hidden', inside <= 0);
  };
  const listen = <K extends keyof WindowEventMap>(type: K, listener: (event: WindowEventMap[K]) => void) =>
    window.addEventListener(type, listener, { signal });

  listen('dragenter', (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    inside++;
    show();
  });
  listen('dragleave', (event) => {
    if (!hasFiles(event)) return;
    inside--;
    show();
  });
  listen('dragover', (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    if (event.dataTransfer) event.dataTransfer.dropEffect = 'copy';
  });
  listen('drop', (event) => {
    inside = 0;
    show();
    if (!event.dataTransfer || !hasFiles(event)) return;
    // Otherwise the browser would navigate to the file.
    event.preventDefault();
    wb.files.drop(event.dataTransfer);
  });
  listen('paste', (event) => {
    const target = event.target;
    if (target instanceof HTMLInputElement || target instanceof HTMLTextAreaElement) return;
    if (!event.clipboardData) return;
    event.preventDefault();
    wb.files.paste(event.clipboardData);
  });
  return veil;
}
