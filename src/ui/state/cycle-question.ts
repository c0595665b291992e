/** Keys waiting for the answer to where they belong. */
import type { ArgsOf } from '../../edit/command.ts';
import type { keyForMoment } from '../../edit/commands/moment.ts';
import type { ChangedCycle, OutsideCycle } from '../../edit/keys/cycle.ts';
import type { Character } from '../../model/document.ts';
import type { Take } from '../../model/takes/take.ts';

/** Seconds of easing before and after a key. */
export interface Easing {
  readonly easeIn: number;
  readonly easeOut: number;
}

/** A pose that was keyed for a moment: while that is the last step, its easing can be dragged on the ruler. */
export interface KeyedMoment {
  readonly args: ArgsOf<typeof keyForMoment>;
  /** Of its step. */
  readonly label: string | undefined;
  /** The take that it has made. */
  readonly take: Take | undefined;
}

export interface CycleQuestion {
  /** The character before the change. */
  readonly character: Character;
  /** What `lengthen` would change; none where only a moment is asked for. */
  readonly changed: readonly ChangedCycle[];
  /** Transport time of the keys. */
  readonly timeSeconds: number;
  /** The same values for a moment, eased in and out; absent if the keys aren't one pose. */
  readonly moment?: {
    /** To begin with. */
    readonly easing: Easing;
    /** Previews it, until another answer is previewed. */
    show(easing: Easing): void;
    /** One step. Throws a `CommandError` if refused. */
    answer(easing: Easing): void;
  };
  /** Previews an answer, until another is previewed. */
  show(outsideCycle: OutsideCycle): void;
  /** Adds the keys in one step. Throws a `CommandError` if refused. */
  answer(outsideCycle: OutsideCycle): void;
  /** Adds no keys. */
  cancel(): void;
}
