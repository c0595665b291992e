/** How the hand works in rig mode: beside the document, and gone with the page. */
import { type Observable, observable } from '../kit/observable.ts';

export const RIG_CHILDREN = ['follow', 'stay'] as const;
/** What the joints below one do when it is dragged. */
export type RigChildren = (typeof RIG_CHILDREN)[number];

const RIG_AXES = ['parent', 'world'] as const;
/** Along which axes the arrows move a joint. */
export type RigAxes = (typeof RIG_AXES)[number];

export class RigHand {
  /** A click on the ground adds a joint. */
  readonly adding: Observable<boolean> = observable(false);
  readonly children: Observable<RigChildren> = observable<RigChildren>('follow');
  readonly axes: Observable<RigAxes> = observable<RigAxes>('parent');
  /** What a drag comes to just now, as a sentence; empty between drags. */
  readonly readout: Observable<string> = observable('');
  /** Counts how often someone asked to name the selected joint. */
  readonly renameAsked: Observable<number> = observable(0);
}
