/** Keys waiting for the answer to where they belong. */
import type { ChangedCycle, OutsideCycle } from '../../edit/keys/cycle.ts';
import type { Character } from '../../model/document.ts';

export interface CycleQuestion {
  /** The character before the change. */
  readonly character: Character;
  /** What `lengthen` would change; at least one channel. */
  readonly changed: readonly ChangedCycle[];
  /** Previews an answer, until another is previewed. */
  show(outsideCycle: OutsideCycle): void;
  /** Adds the keys in one step. Throws a `CommandError` if refused. */
  answer(outsideCycle: OutsideCycle): void;
  /** Adds no keys. */
  cancel(): void;
}
