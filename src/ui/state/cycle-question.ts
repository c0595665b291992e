/** Keys that wait until it is said where they go. */
import type { ChangedCycle, OutsideCycle } from '../../edit/keys/cycle.ts';
import type { Character } from '../../model/document.ts';

export interface CycleQuestion {
  /** As it was before. */
  readonly character: Character;
  /** What `lengthen` would change; at least one. */
  readonly changed: readonly ChangedCycle[];
  /** Shows what an answer would give, until another is shown. */
  show(outsideCycle: OutsideCycle): void;
  /** Makes the keys: one step. Throws a `CommandError` where that is refused. */
  answer(outsideCycle: OutsideCycle): void;
  /** Makes none. */
  cancel(): void;
}
