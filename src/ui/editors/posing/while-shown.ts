/** Controls of a mode, created once; they listen to nothing while another mode's are shown. */
import type { Posing } from '../../state/posing.ts';

/**
 * @param controls set as `posing.controls`, and cleared again
 * @param listen called when shown; returns unsubscribe functions, called when hidden
 */
export function whileShown(
  posing: Pick<Posing, 'controls'>,
  controls: HTMLElement,
  listen: () => readonly (() => void)[],
): void {
  let stops: readonly (() => void)[] = [];
  posing.controls.subscribe((now, before) => {
    if (before === controls) {
      for (const stop of stops) stop();
      stops = [];
    }
    if (now === controls) stops = listen();
  });
}
