/** What keeps points from where they should be. */
export interface Hindrance {
  /** The character's DOFs that stand at a limit and would go on. */
  readonly binding: readonly number[];
  /** Joints of the pins that hold the dragged point back, the strongest first. */
  readonly holders: readonly number[];
  /** Locked joints without whose lock the points would come nearer, the one that would bend most first. */
  readonly locks: readonly number[];
  /** Whether anything that is free moves the dragged point at all. */
  readonly canMove: boolean;
  /** Whether the character could travel as a whole, and is not let. */
  readonly rootStays: boolean;
}

export type GapCause = 'root' | 'locks' | 'limits' | 'pins' | 'reach';

/** What is the first thing in the way: what one would change. */
export function gapCause({ binding, holders, locks, canMove, rootStays }: Hindrance): GapCause {
  if (!canMove) return rootStays ? 'root' : 'locks';
  if (binding.length > 0) return 'limits';
  if (locks.length > 0) return 'locks';
  if (holders.length > 0) return 'pins';
  return rootStays ? 'root' : 'reach';
}
