/** Locked DOFs: what is set or keyed by hand leaves them alone, and says how many they were. */
import type { Character } from '../../model/document.ts';
import { lockedDofs } from '../../model/sets.ts';
import { CommandError } from '../command-error.ts';

/** Those of some DOFs that are not locked, and the number of those that are. */
export interface Unlocked<T> {
  readonly open: T;
  readonly locked: number;
}

/**
 * The values of DOFs that are not locked; the same object if none is.
 *
 * @throws AllLockedError if all are
 */
export function openValues(
  character: Character,
  values: ReadonlyMap<number, number>,
): Unlocked<ReadonlyMap<number, number>> {
  const locks = lockedDofs(character);
  if (locks.size === 0) return { open: values, locked: 0 };
  const open = new Map([...values].filter(([dof]) => !locks.has(dof)));
  const locked = values.size - open.size;
  if (locked === 0) return { open: values, locked };
  if (open.size === 0) throw new AllLockedError(locked);
  return { open, locked };
}

/** Refuses a change of which nothing is left, as all of so many DOFs are locked. */
export class AllLockedError extends CommandError {
  constructor(readonly count: number) {
    super(`${count === 1 ? 'This DOF is' : `All ${count} DOFs are`} locked. Unlock what is to be changed.`);
  }
}
