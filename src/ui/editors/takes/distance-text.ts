/** Distances as text: in centimetres or metres where both characters say what their unit is, else as bare numbers. */
import type { Character } from '../../../model/document.ts';
import { shown } from '../../kit/number-text.ts';

export interface DistanceUnit {
  /** What a distance is multiplied by. */
  readonly factor: number;
  /** Empty where nobody knows. */
  readonly symbol: string;
}

const hasUnit = ({ space }: Character) => space !== undefined && space.unit !== 'asIs';

/** One for all numbers of a comparison, so that they can be compared. @param largest of the distances */
export function distanceUnit(a: Character, b: Character, largest: number): DistanceUnit {
  if (!hasUnit(a) || !hasUnit(b)) return { factor: 1, symbol: '' };
  return largest < 2 ? { factor: 100, symbol: 'cm' } : { factor: 1, symbol: 'm' };
}

/** Three figures or so: `12.3`, `0.123`. */
export function distanceNumber(distance: number, { factor }: DistanceUnit): string {
  const value = distance * factor;
  const whole = Math.floor(Math.log10(Math.max(1e-3, value))) + 1;
  return shown(value, Math.max(0, 3 - Math.max(0, whole)));
}

export function distanceText(distance: number, unit: DistanceUnit): string {
  return `${distanceNumber(distance, unit)}${unit.symbol && ` ${unit.symbol}`}`;
}
