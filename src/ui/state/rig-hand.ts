/** State of rig mode outside the document, not remembered. */
import { type Observable, observable } from '../widgets/observable.ts';

export const RIG_CHILDREN = ['follow', 'stay'] as const;
/** What the children of a dragged joint do. */
export type RigChildren = (typeof RIG_CHILDREN)[number];

const RIG_AXES = ['parent', 'world'] as const;
/** Axes along which the arrows move a joint. */
export type RigAxes = (typeof RIG_AXES)[number];

export class RigHand {
  /** A click on the ground adds a joint. */
  readonly adding: Observable<boolean> = observable(false);
  readonly children: Observable<RigChildren> = observable<RigChildren>('follow');
  readonly axes: Observable<RigAxes> = observable<RigAxes>('parent');
  /** Result of the current drag, as a sentence; empty between drags. */
  readonly readout: Observable<string> = observable('');
  /** Counts requests to rename the selected joint. */
  readonly renameAsked: Observable<number> = observable(0);
}
