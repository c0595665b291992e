/** The whole page takes files: dropped anywhere, or pasted. What is in them is someone else's business. */
import { element } from '../kit/dom.ts';
import type { Uses } from '../state/workbench.ts';

export function dropTarget(wb: Uses<'files'>, signal: AbortSignal): HTMLElement {
  const veil = element(
    'div',
    { class: 'drop-veil', hidden: true, 'aria-hidden': 'true' },
    element('p', {}, 'Drop to open'),
  );
  const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
  // Every element that is dragged over enters and leaves: only their sum tells whether the page is left.
  let inside = 0;
  const show = () => {
    veil.hidden = inside <= 0;
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
    // Without this the browser leaves the page for the file.
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
