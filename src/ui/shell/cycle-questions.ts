/** Opens and closes the dialog together with the pending question of `add-keys.ts`. */
import type { Uses } from '../state/workbench.ts';

/** Runs until ended. Closing the dialog without an answer makes no keys. */
export function askAboutCycles({ timeline, dialog }: Uses<'timeline' | 'dialog'>): () => void {
  const { cycleQuestion } = timeline;
  const stops = [
    cycleQuestion.subscribe((question) => {
      if (question) dialog.set('outsideCycle');
      else if (dialog.get() === 'outsideCycle') dialog.set(undefined);
    }),
    dialog.subscribe((name) => {
      if (name !== 'outsideCycle') cycleQuestion.get()?.cancel();
    }),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}
