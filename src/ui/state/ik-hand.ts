/**
 * IK state outside the document: the selected pin, and where pins hold. Shared by the viewport's tool and the
 * inspector, which are separate scripts.
 */
import { HeldTargets } from '../../evaluate/ik/drag/held-targets.ts';
import { type Observable, observable } from '../kit/observable.ts';

/** A pin of a character, by its id. */
export interface PinRef {
  readonly characterId: string;
  readonly pin: number;
}

export class IkHand {
  /** May no longer exist: use `selectedPin`. */
  readonly selected: Observable<PinRef | undefined> = observable<PinRef | undefined>(undefined);
  /** Highlighted by a row of the inspector. */
  readonly pointedAt: Observable<PinRef | undefined> = observable<PinRef | undefined>(undefined);
  readonly targets = new HeldTargets();
  /** Whether anything was dragged yet: until then a hint is shown. */
  readonly hasDragged: Observable<boolean> = observable(false);
  /** Whether the current or last drag needed the root to move. */
  readonly wantsRoot: Observable<boolean> = observable(false);
}
