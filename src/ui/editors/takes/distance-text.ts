/** Distances as text: in centimetres or metres if both characters state their unit, else as plain numbers. */
import type { Character } from '../../../model/document.ts';
import { shown } from '../../widgets/numbers/number-text.ts';

export interface DistanceUnit {
  /** Factor from the model's distances. */
  readonly factor: number;
  /** Empty if unknown. */
  readonly symbol: string;
}

const hasUnit = ({ space }: Character) => space !== undefined && space.unit !== 'asIs';

/** One unit for all numbers of a comparison. @param largest of the distances */
export function distanceUnit(a: Character, b: Character, largest: number): DistanceUnit {
  if (!hasUnit(a) || !hasUnit(b)) return { factor: 1, symbol: '' };
  return largest < 2 ? { factor: 100, symbol: 'cm' } : { factor: 1, symbol: 'm' };
}

/** About three significant figures: `12.3`, `0.123`. */
export function distanceNumber(distance: number, { factor }: DistanceUnit): string {
  const value = distance * factor;
  const whole = Math.floor(Math.log10(Math.max(1e-3, value))) + 1;
  return shown(value, Math.max(0, 3 - Math.max(0, whole)));
}

export function distanceText(distance: number, unit: DistanceUnit): string {
  return `${distanceNumber(distance, unit)}${unit.symbol && ` ${unit.symbol}`}`;
}

/** Head of a column of `distanceNumber`s: `Mean (cm)`; without a known unit only the label. */
export function columnText(label: string, { symbol }: DistanceUnit): string {
  return symbol ? `${label} (${symbol})` : label;
}
