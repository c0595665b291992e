/** What rig mode remembers beside the document: how the hand works in it. One for each page. */
import { type Observable, observable } from '../../kit/observable.ts';
import type { Posing } from '../../state/posing.ts';
import type { Workbench } from '../../state/workbench.ts';

export const RIG_CHILDREN = ['follow', 'stay'] as const;
/** What the joints below one do when it is dragged. */
export type RigChildren = (typeof RIG_CHILDREN)[number];

const RIG_AXES = ['parent', 'world'] as const;
/** Along which axes the arrows move a joint. */
export type RigAxes = (typeof RIG_AXES)[number];

export interface RigState {
  /** A click on ground adds a joint. */
  readonly adding: Observable<boolean>;
  readonly children: Observable<RigChildren>;
  readonly axes: Observable<RigAxes>;
  /** What a drag comes to just now, as a sentence; empty between drags. */
  readonly readout: Observable<string>;
  /** Counts how often someone asked to name the selected joint. */
  readonly renameAsked: Observable<number>;
}

const states = new WeakMap<Posing, RigState>();

export function rigState({ posing }: Pick<Workbench, 'posing'>): RigState {
  let state = states.get(posing);
  if (!state) {
    state = {
      adding: observable(false),
      children: observable<RigChildren>('follow'),
      axes: observable<RigAxes>('parent'),
      readout: observable(''),
      renameAsked: observable(0),
    };
    states.set(posing, state);
  }
  return state;
}
