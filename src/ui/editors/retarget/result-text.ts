/** Summary of a retargeting. */
import type { Sliding } from '../../../evaluate/retarget/sliding.ts';
import type { Driver } from '../../../model/document.ts';
import type { Skeleton } from '../../../model/skeleton.ts';
import { plural, shown } from '../../kit/number-text.ts';

export function retargetText({ pairs, options }: Driver, skeleton: Skeleton, sliding: Sliding): string {
  const following = `${pairs.length} of ${plural(skeleton.joints.length, 'joint')} follow.`;
  if (sliding.contacts === 0) return `${following} No foot contacts found.`;
  const feet = options.plantsFeet ? 'Feet are planted' : 'Feet are not planted';
  const slide = `slide ${centimetres(sliding.mean)} on average, ${centimetres(sliding.worst)} at most`;
  const other = `${centimetres(sliding.sourceMean)} and ${centimetres(sliding.sourceWorst)}`;
  return `${following} ${feet}: over ${plural(sliding.contacts, 'contact')} they ${slide} (source at this scale: ${other}).`;
}

function centimetres(metres: number): string {
  return `${shown(100 * metres, 1)} cm`;
}
