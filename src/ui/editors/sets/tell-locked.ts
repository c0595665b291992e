/** Says how many locked DOFs a step has left alone. */
import type { Uses } from '../../state/workbench.ts';
import { plural } from '../../widgets/numbers/number-text.ts';

/** Follows steps until ended. */
export function tellLocked({ store, messages }: Uses<'store' | 'messages'>): () => void {
  return store.onStep((_now, _before, { locked = 0 }) => {
    if (locked > 0) messages.note(`${plural(locked, 'locked DOF')} left alone.`);
  });
}
