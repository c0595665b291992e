/** In FK mode and with the select tool pins don't hold, but stay visible, dimmed. What draws them is loaded with the first pin. */
import type { PosingMode } from '../state/posing.ts';
import type { Workbench } from '../state/workbench.ts';

const SHOWN_IN: readonly PosingMode[] = ['select', 'fk'];

/** The overlay that draws dimmed pins. */
async function fetchOverlay(wb: Workbench) {
  const [{ PinOverlay }, { paintDimmedPins }] = await Promise.all([
    import('../../view/pins/pin-overlay.ts'),
    import('../editors/ik/pin-picture.ts'),
  ]);
  return new PinOverlay((painter) => paintDimmedPins(wb, painter));
}

/** @param signal removes the pins with their listeners */
export function pinsInFk(wb: Workbench, signal: AbortSignal, load = fetchOverlay): void {
  let remove: (() => void) | undefined;
  let isLoading = false;
  const isDue = () =>
    !signal.aborted &&
    SHOWN_IN.includes(wb.posing.mode.get()) &&
    wb.store.document.characters.some(({ ik, isHidden }) => !isHidden && (ik?.pins.length ?? 0) > 0);
  const show = async () => {
    if (!isDue()) {
      remove?.();
      remove = undefined;
      return;
    }
    if (remove || isLoading) return;
    isLoading = true;
    // Without it only the pins are missing: retried at the next change.
    const overlay = await load(wb).catch(() => undefined);
    isLoading = false;
    if (!overlay) return;
    if (isDue()) remove = wb.viewport.addOverlay(overlay);
    else overlay.dispose();
  };
  const update = () => void show();
  const stops = [
    wb.posing.mode.subscribe(update),
    wb.store.subscribe((now, before) => {
      if (now.document.characters !== before.document.characters) update();
    }),
  ];
  signal.addEventListener('abort', () => {
    for (const stop of stops) stop();
    update();
  });
  update();
}
