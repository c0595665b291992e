import type { Uses } from './workbench.ts';

/** Aborted when the dialog that is shown closes, or another one takes its place. */
export function untilClosed({ dialog }: Uses<'dialog'>): AbortSignal {
  const closing = new AbortController();
  const shown = dialog.get();
  const stop = dialog.subscribe((now) => {
    if (now === shown) return;
    stop();
    closing.abort();
  });
  return closing.signal;
}
