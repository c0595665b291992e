/** Limits the memory that undo keeps: the oldest steps are dropped, and a message says so. */
import { stepsToForget } from '../../edit/history-budget.ts';
import type { Action, Uses } from '../state/workbench.ts';
import { bytes, plural } from '../widgets/numbers/number-text.ts';

const MEGABYTE = 1e6;
/** Without a choice: a quarter of what the browser gives, up to this. */
const MAX_MEGABYTES = 512;
const CHOICES = [0, 128, 256, 512, 1000, 4000] as const;
/** Steps of a drag or of held keys are weighed once. */
const REST_MS = 300;

/** Not in the DOM's types: Chromium only. */
interface MemoryOf {
  readonly memory?: { readonly jsHeapSizeLimit: number };
}

/** Bytes of a quarter of the script's memory, as far as the browser tells. */
export function defaultUndoBytes(from: MemoryOf): number {
  const heap = from.memory?.jsHeapSizeLimit;
  return Math.min(MAX_MEGABYTES * MEGABYTE, heap ? heap / 4 : Infinity);
}

function undoBytes({ settings }: Uses<'settings'>): number {
  const { undoMegabytes } = settings.get();
  // `memory` isn't standard.
  return undoMegabytes > 0 ? undoMegabytes * MEGABYTE : defaultUndoBytes(performance as MemoryOf);
}

/** Drops the oldest steps whenever undo keeps more than the setting allows. Returns a function that ends this. */
export function limitUndo(wb: Uses<'store' | 'settings' | 'messages'>): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let hasTold = false;
  const limit = () => {
    timer = undefined;
    const { store, messages } = wb;
    const most = undoBytes(wb);
    const count = stepsToForget(store.stored, store.document, most);
    if (count === 0) return;
    store.forgetOldest(count);
    const steps = count === 1 ? 'the oldest step can' : `the oldest ${plural(count, 'step')} can`;
    const text = `Undo keeps at most ${bytes(most)} (Edit > Memory for undo): ${steps} no longer be undone.`;
    // Listed once; large files would fill the list.
    messages.note(text, hasTold ? 'info' : 'warning');
    hasTold = true;
  };
  const soon = () => {
    timer ??= setTimeout(limit, REST_MS);
  };
  const stops = [
    wb.store.subscribe(({ document }, before) => {
      if (document !== before.document) soon();
    }),
    wb.settings.subscribe(soon),
  ];
  return () => {
    clearTimeout(timer);
    for (const stop of stops) stop();
  };
}

export const UNDO_MEMORY_ACTIONS: readonly Action[] = CHOICES.map((megabytes): Action => {
  const label = () =>
    megabytes === 0 ? `Automatic (${bytes(defaultUndoBytes(performance as MemoryOf))})` : bytes(megabytes * MEGABYTE);
  return {
    id: `edit.undoMemory.${megabytes}`,
    name: `Memory for undo: ${megabytes === 0 ? 'automatic' : bytes(megabytes * MEGABYTE)}`,
    label,
    group: 'Edit',
    menu: 'Edit/Memory for undo',
    also: 'history limit preference',
    section: 5,
    radio: true,
    checked: (wb) => wb.settings.get().undoMegabytes === megabytes,
    run: (wb) => wb.settings.update((settings) => ({ ...settings, undoMegabytes: megabytes })),
  };
});
