/** Degrees stop here: the document, its commands and everything evaluated are in radians. */
import type { DofUnit } from '../model/skeleton.ts';
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
