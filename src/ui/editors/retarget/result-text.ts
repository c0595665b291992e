/** Summary of a retargeting. */
import type { Measured } from '../../../evaluate/retarget/measure.ts';
import type { Driver } from '../../../model/document.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';

export function retargetText(driver: Driver, skeleton: Skeleton, measured: Measured): string {
  const following = `${driver.pairs.length} of ${plural(skeleton.joints.length, 'joint')} follow.`;
  return [following, likenessText(measured), feetText(driver, measured)].filter(Boolean).join(' ');
}

function likenessText({ departure, limbs, limbsMean, limbsWorst, tips, tipsMean, tipsWorst }: Measured): string {
  if (departure !== undefined)
    return `The skeletons are identical: joints are off by at most ${centimetres(departure)}.`;
  if (limbs === 0) return '';
  const ends = tips > 0 ? `; feet and hands within ${degrees(tipsMean)}, ${degrees(tipsWorst)} at most` : '';
  return `Arms and legs point within ${degrees(limbsMean)} of the source’s on average, ${degrees(limbsWorst)} at most${ends}.`;
}

function feetText({ options }: Driver, measured: Measured): string {
  const { contacts, allContacts, mean, worst, sourceMean, sourceWorst } = measured;
  if (contacts === 0) return 'No foot contacts found.';
  const feet = options.plantsFeet ? 'Feet are planted' : 'Feet are not planted';
  const over = contacts < allContacts ? `${contacts} of ${allContacts} contacts` : plural(contacts, 'contact');
  const slide = `slide ${centimetres(mean)} on average, ${centimetres(worst)} at most`;
  const other = `${centimetres(sourceMean)} and ${centimetres(sourceWorst)}`;
  return `${feet}: over ${over} they ${slide} (source at this scale: ${other}).`;
}

function degrees(value: number): string {
  return `${shown(value, 1)}°`;
}

function centimetres(metres: number): string {
  return `${shown(100 * metres, 1)} cm`;
}
