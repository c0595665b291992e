/** Why points can't reach their targets. */
export interface Hindrance {
  /** The character's DOFs that are at a limit and would move further. */
  readonly binding: readonly number[];
  /** Joints of the pins that hold the dragged point back, the strongest first. */
  readonly holders: readonly number[];
  /** Locked joints that keep the points from coming nearer; the one that would bend most first. */
  readonly locks: readonly number[];
  /** Whether any free DOF moves the dragged point. */
  readonly canMove: boolean;
  /** Whether the character could move as a whole, but its root is fixed. */
  readonly rootStays: boolean;
}

/**
 * The main reason why a point can't reach its target: a root that must not move, locked joints, limits, other pins, or
 * the length of the limbs.
 */
export type GapCause = 'root' | 'locks' | 'limits' | 'pins' | 'reach';

/** The main cause, which the user should change first. */
export function gapCause({ binding, holders, locks, canMove, rootStays }: Hindrance): GapCause {
  if (!canMove) return rootStays ? 'root' : 'locks';
  if (binding.length > 0) return 'limits';
  if (locks.length > 0) return 'locks';
  if (holders.length > 0) return 'pins';
  return rootStays ? 'root' : 'reach';
}
