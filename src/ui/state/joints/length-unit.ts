/** Names of length units. */
import type { Character } from '../../../model/document.ts';
import type { LengthUnit } from '../../../model/space.ts';

const NAMES: Readonly<Record<LengthUnit, string>> = {
  asIs: 'units',
  metres: 'm',
  decimetres: 'dm',
  centimetres: 'cm',
  millimetres: 'mm',
  inches: 'in',
  cmu: 'units',
  own: 'units',
};

/** Unit text after a length in the character's own unit: `cm`; `units` if it has no name. */
export function lengthUnit({ space }: Pick<Character, 'space'>): string {
  return NAMES[space?.unit ?? 'asIs'];
}
