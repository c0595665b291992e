/**
 * The page's dialogs: one at a time, named by `wb.dialog`. The native `<dialog>` handles focus and Escape. Their
 * scripts are loaded on first use, that of the search when the page is idle; until then the dialog counts as open, and
 * keys are kept for it.
 */

import { onDemand, whenIdle } from '../state/on-demand.ts';
import type { DialogName, Workbench } from '../state/workbench.ts';
import type { DialogContent } from '../widgets/dialog.ts';
import { button, element } from '../widgets/dom.ts';
import { icon } from '../widgets/icons.ts';
import { keepKeys, replayKeys } from './start/early-keys.ts';

type MakeDialog = (wb: Workbench, close: () => void) => DialogContent;

const curveTools = () => import('../editors/curves/dialogs/tool-dialogs.ts');
const sampleTools = () => import('../editors/curves/dialogs/sample-dialogs.ts');

const exchange = () => import('./dialogs/exchange-dialog.ts');

const takeTools = () => import('../editors/takes/edit-dialogs.ts');

const LOAD: Readonly<Record<DialogName, () => Promise<MakeDialog>>> = {
  shortcuts: async () => (await import('./help/shortcuts-page.ts')).shortcutsPage,
  search: async () => (await import('./help/command-search.ts')).commandSearch,
  save: async () => (await import('./save-list.ts')).saveList,
  picture: async () => (await import('./dialogs/picture-dialogs.ts')).pictureDialog,
  video: async () => (await import('./dialogs/picture-dialogs.ts')).videoDialog,
  glb: async () => (await exchange()).exchangeDialog('glb'),
  fbx: async () => (await exchange()).exchangeDialog('fbx'),
  vrma: async () => (await exchange()).exchangeDialog('vrma'),
  programs: async () => (await import('./help/programs-page.ts')).programsPage,
  about: async () => (await import('./help/about.ts')).aboutDialog,
  simplify: async () => (await curveTools()).simplifyDialog,
  resample: async () => (await curveTools()).resampleDialog,
  bake: async () => (await curveTools()).bakeDialog,
  scaleKeys: async () => (await curveTools()).scaleDialog,
  convertToKeys: async () => (await sampleTools()).convertDialog,
  smoothSamples: async () => (await sampleTools()).smoothDialog,
  resampleSamples: async () => (await sampleTools()).resampleSamplesDialog,
  markers: async () => (await import('../editors/timeline/markers/markers-dialog.ts')).markersDialog,
  loopTake: async () => (await takeTools()).loopDialog,
  lockFeet: async () => (await takeTools()).lockFeetDialog,
  joinTakes: async () => (await takeTools()).joinDialog,
  insertTake: async () => (await takeTools()).insertDialog,
  cutOut: async () => (await takeTools()).cutOutDialog,
  takeSpeed: async () => (await takeTools()).speedDialog,
  checkTake: async () => (await import('../editors/takes/check-dialog.ts')).checkDialog,
  outsideCycle: async () => (await import('../editors/timeline/cycle-dialog.ts')).cycleDialog,
  retarget: async () => (await import('../editors/retarget/dialog.ts')).retargetDialog,
  attach: async () => (await import('../editors/attach/dialog.ts')).attachDialog,
  holdPins: async () => (await import('../editors/ik/hold-dialog.ts')).holdDialog,
  skinWeights: async () => (await import('../editors/skin/weights-dialog.ts')).weightsDialog,
};

export function startDialogs(wb: Workbench, root: HTMLElement): void {
  let shown: HTMLDialogElement | undefined;
  let waiting = new AbortController();
  const close = () => wb.dialog.set(undefined);
  wb.dialog.subscribe(async (name) => {
    shown?.close();
    shown = undefined;
    waiting.abort();
    if (!name) return;
    const own = new AbortController();
    waiting = own;
    const early = keepKeys(own.signal, close);
    const make = await onDemand(wb.messages, 'The dialog', LOAD[name]);
    // It was closed meanwhile, or another one was opened.
    if (own.signal.aborted) return;
    own.abort();
    if (!make) return close();
    shown = showDialog(root, make(wb, close), close, (dialog) => dialog === shown);
    replayKeys(early, shown);
  });
  // Whoever presses Ctrl+K types on at once. If it fails to load, opening it says so.
  whenIdle(wb, () => void LOAD.search().catch(() => {}));
}

/** @param isShown whether the page still considers it open */
function showDialog(
  root: HTMLElement,
  { title, body, kind, bare, stays }: DialogContent,
  close: () => void,
  isShown: (dialog: HTMLDialogElement) => boolean,
): HTMLDialogElement {
  const head = element(
    'div',
    { class: 'dialog-head' },
    element('h2', {}, title),
    button('Close', { class: 'tool' }, icon('close'), close),
  );
  const dialog = element('dialog', { class: `dialog ${kind}`, 'aria-label': title }, !bare && head, body);
  dialog.addEventListener('close', () => {
    dialog.remove();
    if (isShown(dialog)) close();
  });
  // At once, also from a field that would revert its number first; but not from a menu, nor from what waits for a key.
  dialog.addEventListener(
    'keydown',
    (event) => {
      if (event.key !== 'Escape' || event.isComposing || dialog.querySelector('.waiting, .menu')) return;
      event.preventDefault();
      event.stopPropagation();
      close();
    },
    { capture: true },
  );
  // A press on the backdrop hits the dialog itself, outside its box.
  dialog.addEventListener('pointerdown', (event) => {
    if (!stays && event.target === dialog && !inside(dialog, event)) close();
  });
  root.append(dialog);
  dialog.showModal();
  // The browser would focus Close.
  const first = ['[autofocus]', 'button:not(:disabled), input:not([hidden] *)']
    .map((wanted) => body.querySelector<HTMLElement>(wanted))
    .find(Boolean);
  (first ?? body).focus({ preventScroll: true });
  return dialog;
}

function inside(target: HTMLElement, { clientX, clientY }: PointerEvent): boolean {
  const box = target.getBoundingClientRect();
  return clientX >= box.left && clientX <= box.right && clientY >= box.top && clientY <= box.bottom;
}
