/** Says how many locked DOFs, and keys that switch limbs, a step has left alone. */
import type { Uses } from '../../state/workbench.ts';
import { plural } from '../../widgets/numbers/number-text.ts';

/** Follows steps until ended. */
export function tellLocked({ store, messages }: Uses<'store' | 'messages'>): () => void {
  return store.onStep((_now, _before, { locked = 0, switches = 0 }) => {
    const said = [
      ...(locked > 0 ? [`${plural(locked, 'locked DOF')} left alone.`] : []),
      ...(switches > 0
        ? [`${plural(switches, 'key')} of IK switches left as steps; select only such keys to change them.`]
        : []),
    ];
    if (said.length > 0) messages.note(said.join(' '));
  });
}
