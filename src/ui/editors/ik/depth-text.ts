/** The readout beside the pointer while a point is dragged in depth. */
import type { Character } from '../../../model/document.ts';
import { lengthUnit } from '../../state/joints/length-unit.ts';
import { aligned } from '../../widgets/numbers/number-text.ts';

/** `depth +0.230 units`: positive is further away. */
export function depthText(character: Pick<Character, 'space'>, depth: number): string {
  const text = aligned(Math.abs(depth));
  const sign = Number(text) === 0 ? '' : depth > 0 ? '+' : '−';
  return `depth ${sign}${text} ${lengthUnit(character)}`;
}
