/** Lengths of file units. */
import type { LengthUnit, Space } from '../model/space.ts';

const INCH = 0.0254;

/** Metres per unit; for `own` the space itself has the value. */
export const METRES: Readonly<Record<Exclude<LengthUnit, 'own'>, number>> = {
  asIs: 1,
  metres: 1,
  decimetres: 0.1,
  centimetres: 0.01,
  millimetres: 0.001,
  inches: INCH,
  cmu: INCH / 0.45,
};

/** Metres per unit of the character's own space. */
export function metresPerUnit({ unit, metres }: Space): number {
  return unit === 'own' ? (metres ?? 1) : METRES[unit];
}
