/** What is said about four attachments, and the scale of the heat map. */

import type { Skin } from '../../../model/skin.ts';
import { vertexCount } from '../../../model/skin.ts';
import type { FourAttachments, KeptFour } from '../../../teaching/program/four-attachments.ts';
import { count, plural, shown } from '../../widgets/numbers/number-text.ts';

export const KEPT_LABELS: Readonly<Record<KeptFour, string>> = {
  'largest four normalised': 'Largest four, normalised',
  'largest four': 'Largest four, as given',
  'first four normalised': 'First four, normalised',
  'first four': 'First four, as given',
};

/** Displacements below this part of the size are rounding: files write weights with six digits or so. */
const ROUNDING = 1e-5;

/**
 * The upper end of the heat map as a part of the size: 1, 2 or 5 times a power of ten, so that it is read easily and
 * stays while a pose changes a little. 0 if nothing is displaced.
 *
 * @param largest displacement as a part of the size
 */
export function heatScale(largest: number): number {
  if (!(largest > ROUNDING && largest < Infinity)) return 0;
  const power = 10 ** Math.floor(Math.log10(largest));
  const step = [1, 2, 5, 10].find((one) => one * power >= largest) ?? 10;
  return step * power;
}

/** `2 % of size`. */
export function scaleText(scale: number): string {
  return scale > 0 ? `${percent(scale)} % of size` : 'no displacement';
}

/** Of the size, with decimals for what is small. */
function percent(part: number): string {
  return shown(Number((100 * part).toPrecision(3)), 6);
}

type Counts = Pick<FourAttachments, 'beyondFour' | 'mostAttachments' | 'unevenSums'>;

/** How many vertices a program with four attachments changes, and why. */
export function attachmentsText(skin: Skin, hasSkeleton: boolean, counts: Counts): string {
  const { beyondFour, mostAttachments, unevenSums } = counts;
  if (!hasSkeleton) return `${skin.name} has no skeleton, so nothing moves its vertices.`;
  if (!skin.attachments) return `${skin.name} has no weights: all of it follows the root.`;
  const uneven =
    unevenSums > 0
      ? ` ${plural(unevenSums, 'vertex has', 'vertices have')} weights that don’t sum to 1, so normalising moves ${unevenSums === 1 ? 'it' : 'them'}.`
      : '';
  if (beyondFour > 0) {
    const all = count(vertexCount(skin));
    return `${count(beyondFour)} of ${all} vertices have more than four attachments, up to ${mostAttachments}.${uneven}`;
  }
  const same = uneven || ' A program that keeps four draws the same.';
  return `No vertex of ${skin.name} has more than four attachments.${same}`;
}
