/** The readout beside the pointer while a point is dragged in depth. */
import type { Character } from '../../../model/document.ts';
import { aligned } from '../../kit/number-text.ts';
import { lengthUnit } from '../../state/length-unit.ts';

/** `depth +0.230 units`: positive is further away. */
export function depthText(character: Pick<Character, 'space'>, depth: number): string {
  const text = aligned(Math.abs(depth));
  const sign = Number(text) === 0 ? '' : depth > 0 ? '+' : '−';
  return `depth ${sign}${text} ${lengthUnit(character)}`;
}
