/** Lengths of file units. */
import { type FileSpace, LENGTH_UNITS, type LengthUnit, type Space } from '../../model/space.ts';

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

/** Units of this relative difference are the same: files store them as they divide or multiply. */
const SAME_UNIT = 1e-6;

/**
 * The space of a file that states its unit, with y up by then. Its ground is that of the file, y = 0.
 * @param metres per unit; greater than 0
 */
export function statedSpace(metres: number): FileSpace {
  const named = LENGTH_UNITS.find(
    (unit) => unit !== 'asIs' && unit !== 'own' && Math.abs(METRES[unit] / metres - 1) < SAME_UNIT,
  );
  const unit = named ? { unit: named } : ({ unit: 'own', metres } as const);
  return { space: { up: 'y', ...unit, lift: 0, known: 'stated' }, standing: 0 };
}
