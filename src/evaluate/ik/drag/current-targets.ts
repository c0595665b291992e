/** The targets of pins now: where a drag left them (`HeldTargets`), else where the pose has their points. */
import type { IkSetup } from '../../../model/ik.ts';
import { type PinTarget, pinTarget } from '../set-up.ts';
import type { HeldTargets } from './held-targets.ts';

/** The current target of each pin, by id. @param world from `worldMatrices`, for the pose of `dofs` */
export function currentTargets(
  held: HeldTargets,
  characterId: string,
  { pins }: Pick<IkSetup, 'pins'>,
  dofs: Float64Array,
  world: Float64Array,
): Map<number, PinTarget> {
  const left = held.leftOf(characterId, dofs);
  return new Map(pins.map((pin) => [pin.id, held.leftTarget(left, pin) ?? pinTarget(pin, world)]));
}
