/** What commands were given for `KeyPlacing`. */
import { oneOf } from './arguments.ts';
import { rangeFrom } from './key-dofs.ts';
import { type KeyPlacing, OUTSIDE_CYCLE } from './keys/cycle.ts';

/** Refuses what does not say where keys outside a cycle go. */
export function checkPlacing({ outsideCycle, bakedRange }: KeyPlacing): void {
  if (outsideCycle !== undefined) oneOf(outsideCycle, OUTSIDE_CYCLE, '"outsideCycle"');
  if (bakedRange !== undefined) rangeFrom(bakedRange, '"bakedRange"');
}
