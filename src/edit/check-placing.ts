/** Checks command arguments of type `KeyPlacing`. */
import { oneOf } from './arguments.ts';
import { rangeFrom } from './key-dofs.ts';
import { type KeyPlacing, OUTSIDE_CYCLE } from './keys/cycle.ts';

/** Refuses invalid settings for keys outside a cycle. */
export function checkPlacing({ outsideCycle, bakedRange }: KeyPlacing): void {
  if (outsideCycle !== undefined) oneOf(outsideCycle, OUTSIDE_CYCLE, '"outsideCycle"');
  if (bakedRange !== undefined) rangeFrom(bakedRange, '"bakedRange"');
}
