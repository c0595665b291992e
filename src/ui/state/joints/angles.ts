/** Conversion to degrees happens here: the document, its commands and all evaluation use radians. */
import type { DofUnit } from '../../../model/skeleton/skeleton.ts';
import { IN_DEGREES, IN_RADIANS, type Units } from '../../widgets/numbers/arithmetic.ts';
import type { Settings } from '../settings.ts';

const DEGREES = 180 / Math.PI;

/** Factor from a document's value to the displayed one. */
export function shownPerUnit(unit: DofUnit, angles: Settings['angles']): number {
  return unit === 'angle' && angles === 'degrees' ? DEGREES : 1;
}

/** Removes rounding noise of converting back and forth. */
export function withoutNoise(value: number): number {
  return Number(value.toPrecision(14));
}

/** `°`, ` rad`, or nothing. */
export function unitText(unit: DofUnit, angles: Settings['angles']): string {
  if (unit !== 'angle') return '';
  return angles === 'degrees' ? '°' : ' rad';
}

/** Units that may be typed after a number: `deg`, `°` and `rad` for angles. */
export function typedUnits(unit: DofUnit | undefined, angles: Settings['angles']): Units {
  if (unit !== 'angle') return NO_UNITS;
  return angles === 'degrees' ? IN_DEGREES : IN_RADIANS;
}

const NO_UNITS: Units = {};
