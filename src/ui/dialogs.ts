/** The page's dialogs: one at a time, named by `wb.dialog`. The browser's own `<dialog>` holds the focus and Escape. */
import { aboutDialog } from './about.ts';
import { commandSearch } from './command-search.ts';
import { convertDialog, resampleSamplesDialog, smoothDialog } from './curves/sample-dialogs.ts';
import { bakeDialog, resampleDialog, scaleDialog, simplifyDialog } from './curves/tool-dialogs.ts';
import type { DialogContent } from './dialog.ts';
import { button, element } from './dom.ts';
import { icon } from './icons.ts';
import { retargetDialog } from './retarget/dialog.ts';
import { saveList } from './save-list.ts';
import { shortcutsPage } from './shortcuts-page.ts';
import type { DialogName, Workbench } from './workbench.ts';

const MAKE: Readonly<Record<DialogName, (wb: Workbench, close: () => void) => DialogContent>> = {
  shortcuts: shortcutsPage,
  search: commandSearch,
  save: saveList,
  about: aboutDialog,
  simplify: simplifyDialog,
  resample: resampleDialog,
  bake: bakeDialog,
  scaleKeys: scaleDialog,
  convertToKeys: convertDialog,
  smoothSamples: smoothDialog,
  resampleSamples: resampleSamplesDialog,
  retarget: retargetDialog,
};

export function startDialogs(wb: Workbench, root: HTMLElement): void {
  let shown: HTMLDialogElement | undefined;
  const close = () => wb.dialog.set(undefined);
  wb.dialog.subscribe((name) => {
    shown?.close();
    if (!name) return;
    const { title, body, kind, bare } = MAKE[name](wb, close);
    const head = element(
      'div',
      { class: 'dialog-head' },
      element('h2', {}, title),
      button('Close', { class: 'tool' }, icon('close'), close),
    );
    const dialog = element('dialog', { class: `dialog ${kind}`, 'aria-label': title }, !bare && head, body);
    dialog.addEventListener('close', () => {
      dialog.remove();
      if (shown !== dialog) return;
      shown = undefined;
      wb.dialog.set(undefined);
    });
    // A press on the backdrop is one on the dialog itself, outside of its box.
    dialog.addEventListener('pointerdown', (event) => {
      if (event.target === dialog && !inside(dialog, event)) close();
    });
    root.append(dialog);
    shown = dialog;
    dialog.showModal();
    // The browser would begin with Close.
    const first = body.querySelector<HTMLElement>('[autofocus], button:not(:disabled), input');
    (first ?? body).focus({ preventScroll: true });
  });
}

function inside(target: HTMLElement, { clientX, clientY }: PointerEvent): boolean {
  const box = target.getBoundingClientRect();
  return clientX >= box.left && clientX <= box.right && clientY >= box.top && clientY <= box.bottom;
}
