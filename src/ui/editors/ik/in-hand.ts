/**
 * What of inverse kinematics is in hand on a page, beside the document: which pin is selected, where pins hold. The
 * viewport's tool and the inspector share it, and each is a script of its own.
 */

import { HeldTargets } from '../../../evaluate/ik/drag/held-targets.ts';
import { ikOf } from '../../../evaluate/ik/set-up.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import type { Pin } from '../../../model/ik.ts';
import { type Observable, observable } from '../../kit/observable.ts';
import type { Workbench } from '../../state/workbench.ts';

/** A pin of a character, by its id. */
export interface PinRef {
  readonly characterId: string;
  readonly pin: number;
}

export class IkInHand {
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

const ofPage = new WeakMap<Workbench, IkInHand>();

export function ikInHand(wb: Workbench): IkInHand {
  let own = ofPage.get(wb);
  if (!own) {
    own = new IkInHand();
    ofPage.set(wb, own);
  }
  return own;
}

/** The pin and its character, if both are still there. */
export function findPin(
  wb: Pick<Workbench, 'store'>,
  ref: PinRef | undefined,
): { readonly character: Character; readonly pin: Pin } | undefined {
  const character = findCharacter(wb.store.document, ref?.characterId);
  const pin = character && ikOf(character).pins.find(({ id }) => id === ref?.pin);
  return character && pin && { character, pin };
}

/** The pin is out of hand where it is gone, or another joint, or none, has been selected. */
export function keepInHand(wb: Workbench, isAnotherSelection: boolean): void {
  const { selected } = ikInHand(wb);
  const ref = selected.get();
  const found = findPin(wb, ref);
  const { characterId, joint } = wb.store.selection;
  const isSelected = characterId === ref?.characterId && joint === found?.pin.joint;
  if (ref && (!found || (isAnotherSelection && !isSelected))) selected.set(undefined);
}

export function selectedPin(wb: Workbench): ReturnType<typeof findPin> {
  return findPin(wb, ikInHand(wb).selected.get());
}
