/** Keys that wait for an answer (`add-keys.ts`) and the dialog that asks for it open and close together. */
import type { Uses } from '../state/workbench.ts';

/** Until it is ended. A dialog that is closed by whatever means without an answer makes no keys. */
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
