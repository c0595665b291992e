/**
 * IK state outside the document: the selected pin, and where pins hold. Shared by the viewport's tool and the
 * inspector, which are separate scripts.
 */
import type { PinAxes } from '../../evaluate/handles/pin-handles.ts';
import { HeldTargets } from '../../evaluate/ik/drag/held-targets.ts';
import { type Observable, observable } from '../widgets/observable.ts';

/** A joint of a character, by its index. */
export interface JointRef {
  readonly characterId: string;
  readonly joint: number;
}

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
  /** The axes of the selected pin's handles. */
  readonly axes: Observable<PinAxes> = observable<PinAxes>('world');
  readonly targets = new HeldTargets();
  /** Where *Chain* ends: the joint that was selected when it was chosen; undefined: chains end at the root. */
  chainTop: JointRef | undefined;
  /** Whether the pointer is on a pin in the viewport. */
  isOverPin = false;
  /** The joint whose point is lit up under the pointer, and would be dragged. */
  over: JointRef | undefined;
  /** What a drag of a joint would move, for the status bar: `Bend upper_arm_l to hand_l`. Given by IK's tool. */
  whatMoves: ((characterId: string, joint: number) => string | undefined) | undefined;
  /** Whether anything was dragged yet: until then a hint is shown. */
  readonly hasDragged: Observable<boolean> = observable(false);
  /** Whether the current or last drag needed the root to move. */
  readonly wantsRoot: Observable<boolean> = observable(false);
}
