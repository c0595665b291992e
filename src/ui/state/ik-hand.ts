/**
 * What of inverse kinematics is in hand, beside the document: which pin is selected, where pins hold. The viewport's
 * tool and the inspector share it, and each is a script of its own.
 */
import { HeldTargets } from '../../evaluate/ik/drag/held-targets.ts';
import { type Observable, observable } from '../kit/observable.ts';

/** A pin of a character, by its id. */
export interface PinRef {
  readonly characterId: string;
  readonly pin: number;
}

export class IkHand {
  /** It may be gone: ask `selectedPin`. */
  readonly selected: Observable<PinRef | undefined> = observable<PinRef | undefined>(undefined);
  /** Lit up by a row of the inspector. */
  readonly pointedAt: Observable<PinRef | undefined> = observable<PinRef | undefined>(undefined);
  readonly targets = new HeldTargets();
  /** Whether the hand has dragged anything yet: until then it is told what it could do. */
  readonly hasDragged: Observable<boolean> = observable(false);
  /** Whether the hand asks, or asked last, for what only a root that travels could give. */
  readonly wantsRoot: Observable<boolean> = observable(false);
}
