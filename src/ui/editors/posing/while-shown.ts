/** What a mode has beside the switch of modes is made once, and listens to nothing while another mode's is shown. */
import type { Posing } from '../../state/posing.ts';

/**
 * @param controls what is put in `posing.controls` and taken away again
 * @param listen at each coming; gives the ways out, which are gone at each going
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
