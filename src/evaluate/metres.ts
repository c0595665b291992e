/** How long the units of files are. */
import type { LengthUnit, Space } from '../model/document.ts';

const INCH = 0.0254;

/** Metres that 1 of a unit is; `own` is said by the space itself. */
export const METRES: Readonly<Record<Exclude<LengthUnit, 'own'>, number>> = {
  asIs: 1,
  metres: 1,
  decimetres: 0.1,
  centimetres: 0.01,
  millimetres: 0.001,
  inches: INCH,
  cmu: INCH / 0.45,
};

/** Metres that 1 in the character's own space stands for. */
export function metresPerUnit({ unit, metres }: Space): number {
  return unit === 'own' ? (metres ?? 1) : METRES[unit];
}
