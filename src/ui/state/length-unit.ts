/** How lengths of a character's files are called. */
import type { Character, LengthUnit } from '../../model/document.ts';

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

/** What stands behind a length in the character's own unit: `cm`; `units` where that is one without a name. */
export function lengthUnit({ space }: Pick<Character, 'space'>): string {
  return NAMES[space?.unit ?? 'asIs'];
}
