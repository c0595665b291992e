/**
 * Ticks of the value axes. Degrees use divisors of the full turn, so that 45° and 90° are always ticks; everything else
 * 1, 2 or 5 times a power of ten, like time (`ruler.ts`).
 */

import { roundStep, wholeNumbers } from '../../../../math/round-steps.ts';
import { shown } from '../../../widgets/numbers/number-text.ts';
import type { AxisName, ValueAxis } from './space.ts';

export interface ValueTick {
  /** In the axis' own unit: radians for angles, even if labels are in degrees. */
  readonly value: number;
  /** Absent on minor ticks. */
  readonly label?: string;
}

const DEGREE = Math.PI / 180;
/** Step in degrees, and its number of minor divisions. Finer and coarser steps are powers of ten. */
const DEGREE_STEPS: readonly (readonly [number, number])[] = [
  [1, 5],
  [2, 2],
  [5, 5],
  [10, 2],
  [15, 3],
  [30, 3],
  [45, 3],
  [90, 2],
  [180, 2],
  [360, 2],
  [720, 2],
  [1800, 5],
];
/** Safety limit. */
const MAX_TICKS = 1000;

/**
 * @param pixels height of the axis
 * @param spacing minimum distance of labels in pixels
 */
export function valueTicks(axis: ValueAxis, pixels: number, spacing: number, inDegrees: boolean): ValueTick[] {
  const unit = inDegrees ? DEGREE : 1;
  const low = axis.low / unit;
  const high = axis.high / unit;
  if (!(high > low) || !(pixels > 0) || !Number.isFinite(high - low)) return [];
  const [step, parts] = stepFor(((high - low) / pixels) * spacing, inDegrees);
  const fine = step / parts;
  return wholeNumbers(low / fine - 1e-9, high / fine + 1e-9, MAX_TICKS).map((i) => {
    const value = i * fine * unit;
    return i % parts === 0 ? { value, label: labelOf((i / parts) * step, step, inDegrees) } : { value };
  });
}

/** Whether an axis is labelled in degrees. */
export function isInDegrees(axis: AxisName, degrees: boolean): boolean {
  return degrees && axis === 'angle';
}

function stepFor(least: number, inDegrees: boolean): readonly [number, number] {
  if (inDegrees && least > 0.5) {
    const found = DEGREE_STEPS.find(([step]) => step >= least * (1 - 1e-9));
    if (found) return found;
  }
  const step = roundStep(least);
  const leading = Math.round(step / 10 ** Math.floor(Math.log10(step) + 1e-9));
  return [step, leading === 2 ? 2 : 5];
}

/** No more decimals than the step has. */
function labelOf(value: number, step: number, inDegrees: boolean): string {
  const decimals = Math.min(12, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
  const size = Math.abs(value);
  const isExtreme = size >= 1e6 || (decimals > 6 && size > 0);
  const text = isExtreme ? value.toExponential(2).replace('-', '−') : shown(value, decimals);
  return inDegrees ? `${text}°` : text;
}
