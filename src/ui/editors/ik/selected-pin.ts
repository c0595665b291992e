/** The selected pin, kept in sync with selection and document. */
import { ikOf } from '../../../evaluate/ik/set-up.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import type { Pin } from '../../../model/ik.ts';
import type { PinRef } from '../../state/ik-hand.ts';
import type { Uses } from '../../state/workbench.ts';

/** The pin and its character, if both still exist. */
export function findPin(
  wb: Uses<'store'>,
  ref: PinRef | undefined,
): { readonly character: Character; readonly pin: Pin } | undefined {
  const character = findCharacter(wb.store.document, ref?.characterId);
  const pin = character && ikOf(character).pins.find(({ id }) => id === ref?.pin);
  return character && pin && { character, pin };
}

/** Deselects the pin if it was removed, or if another joint, or none, was selected. */
export function deselectLostPin(wb: Uses<'store' | 'posing'>, isAnotherSelection: boolean): void {
  const { selected } = wb.posing.ik;
  const ref = selected.get();
  const found = findPin(wb, ref);
  const { characterId, joint } = wb.store.selection;
  const isSelected = characterId === ref?.characterId && joint === found?.pin.joint;
  if (ref && (!found || (isAnotherSelection && !isSelected))) selected.set(undefined);
}

export function selectedPin(wb: Uses<'store' | 'posing'>): ReturnType<typeof findPin> {
  return findPin(wb, wb.posing.ik.selected.get());
}
