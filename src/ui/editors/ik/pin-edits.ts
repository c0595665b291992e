/** Pinning, unpinning and locking, for mouse, keys, menus and inspector. */
import { clearPins, pinPoint, setPin, setRootFree, setStiffness, unpin } from '../../../edit/commands/ik.ts';
import { inTurn } from '../../../edit/in-turn.ts';
import { defaultPinPoint } from '../../../evaluate/ik/pin-points.ts';
import { ikOf } from '../../../evaluate/ik/set-up.ts';
import type { Vec3 } from '../../../math/vec3.ts';
import { type Character, findCharacter, shownSkin } from '../../../model/document.ts';
import { attempt } from '../../state/actions/attempt.ts';
import type { PinRef } from '../../state/ik-hand.ts';
import { jointsText } from '../../state/joints/selected-joint.ts';
import type { Uses } from '../../state/workbench.ts';

/**
 * Pins a point without selecting the pin: arrow keys, which orbit the view, would then move it.
 *
 * @param point in the joint's space
 */
export function pinAt(wb: Uses<'store' | 'messages'>, characterId: string, joint: number, point: Vec3): void {
  attempt(wb.messages, () => {
    wb.store.apply(pinPoint, { characterId, joint, point });
    // The inspector shows it.
    if (wb.store.selection.characterId !== characterId) wb.store.select({ characterId, joint });
  });
}

export function unpinByHand(wb: Uses<'store' | 'posing' | 'messages'>, { characterId, pin }: PinRef): void {
  attempt(wb.messages, () => wb.store.apply(unpin, { characterId, pins: [pin] }));
  const { selected } = wb.posing.ik;
  const now = selected.get();
  if (now?.characterId === characterId && now.pin === pin) selected.set(undefined);
}

export function letAllGo(wb: Uses<'store' | 'posing' | 'messages'>, characterId: string): void {
  attempt(wb.messages, () => wb.store.apply(clearPins, { characterId }));
  wb.posing.ik.selected.set(undefined);
}

/** Pins joints at their default points; removes all their pins if each has one. */
export function togglePins(
  wb: Uses<'store' | 'posing' | 'messages'>,
  character: Character,
  joints: readonly number[],
): void {
  const { skeleton, id: characterId } = character;
  if (!skeleton) return;
  const pins = ikOf(character).pins.filter((pin) => joints.includes(pin.joint));
  const free = joints.filter((joint) => !pins.some((pin) => pin.joint === joint));
  if (free.length === 0) {
    attempt(wb.messages, () => wb.store.apply(unpin, { characterId, pins: pins.map(({ id }) => id) }));
    return;
  }
  const pointOf = (joint: number) => defaultPinPoint(skeleton, joint, shownSkin(character)).point;
  const each = free.map((joint) => ({ characterId, joint, point: pointOf(joint) }));
  attempt(wb.messages, () => {
    wb.store.apply(inTurn(pinPoint, `Pin ${jointsText(skeleton, free)}`), each);
    // Pinned by key: select the pin, to continue by keys.
    const made = ikOf(findCharacter(wb.store.document, characterId) ?? character).pins.at(-1);
    if (made && joints.length === 1) wb.posing.ik.selected.set({ characterId, pin: made.id });
  });
}

/**
 * Selects a pin, and its joint.
 *
 * @param placement the instance it was picked in; absent if that doesn't matter, as in a list
 */
export function selectPin(wb: Uses<'store' | 'posing'>, ref: PinRef, joint: number, placement?: number): void {
  wb.posing.ik.selected.set(ref);
  wb.store.select({ characterId: ref.characterId, ...(placement !== undefined && { placement }), joint });
}

export function stiffen(
  wb: Uses<'store' | 'messages'>,
  characterId: string,
  joints: readonly number[],
  stiffness: number | 'locked' | 'usual',
): void {
  attempt(wb.messages, () => wb.store.apply(setStiffness, { characterId, joints, stiffness }));
}

function isLocked(character: Character, joint: number): boolean {
  return ikOf(character).stiff.some((one) => one.joint === joint && one.stiffness === undefined);
}

/** Locks joints; if all are locked, restores their default. */
export function toggleLocks(wb: Uses<'store' | 'messages'>, character: Character, joints: readonly number[]): void {
  const areLocked = joints.every((joint) => isLocked(character, joint));
  stiffen(wb, character.id, joints, areLocked ? 'usual' : 'locked');
}

export function freeRoot(wb: Uses<'store' | 'messages'>, characterId: string, isFree: boolean): void {
  attempt(wb.messages, () => wb.store.apply(setRootFree, { characterId, isFree }));
}

export function changePin(
  wb: Uses<'store' | 'messages'>,
  { characterId, pin }: PinRef,
  change: { readonly weight?: number; readonly holdsOrientation?: boolean },
): void {
  attempt(wb.messages, () => wb.store.apply(setPin, { characterId, pin, ...change }));
}
