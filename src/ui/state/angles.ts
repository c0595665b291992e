/** Degrees stop here: the document, its commands and everything evaluated are in radians. */
import type { DofUnit } from '../../model/skeleton.ts';
import type { Units } from '../kit/arithmetic.ts';
import type { Settings } from './settings.ts';

const DEGREES = 180 / Math.PI;

/** What a document's value is multiplied by to be shown. */
export function shownPerUnit(unit: DofUnit, angles: Settings['angles']): number {
  return unit === 'angle' && angles === 'degrees' ? DEGREES : 1;
}

/** Cuts the noise that the conversion there and back leaves in the last digits. */
export function withoutNoise(value: number): number {
  return Number(value.toPrecision(14));
}

/** `°`, ` rad`, or nothing. */
export function unitText(unit: DofUnit, angles: Settings['angles']): string {
  if (unit !== 'angle') return '';
  return angles === 'degrees' ? '°' : ' rad';
}

/** What may be typed behind a number of that unit: `deg`, `°` and `rad` behind angles. */
export function typedUnits(unit: DofUnit | undefined, angles: Settings['angles']): Units {
  if (unit !== 'angle') return NO_UNITS;
  return angles === 'degrees' ? IN_DEGREES : IN_RADIANS;
}

/** The same where only the words behind the field are known: `°`, `rad`, `s`, `cm`. */
export function unitsBehind(words: string): Units {
  if (words === '°') return IN_DEGREES;
  return words === 'rad' ? IN_RADIANS : { [words.toLowerCase()]: 1 };
}

const NO_UNITS: Units = {};
const IN_DEGREES: Units = { deg: 1, '°': 1, rad: DEGREES };
const IN_RADIANS: Units = { deg: 1 / DEGREES, '°': 1 / DEGREES, rad: 1 };
