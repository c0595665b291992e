/** The frame rate of what plays. */
import { frameRateOf } from '../evaluate/samples/frame-rate.ts';
import { type Document, playingCharacters, shownTake } from '../model/document.ts';

/** Frame rates of everything that plays and is visible; undefined for takes without a rate. */
function ratesPlayed(document: Document): (number | undefined)[] {
  const takes = playingCharacters(document).map((c) => c.driver?.source.take ?? shownTake(c));
  return takes.map((take) => take && frameRateOf(take));
}

/** The frame rate of everything that plays; undefined if there are several, or none. */
export function sharedFrameRate(document: Document): number | undefined {
  const [rate, ...others] = ratesPlayed(document);
  const isOne = rate !== undefined && others.every((r) => r !== undefined && Math.abs(r - rate) <= 1e-6 * rate);
  return isOne ? rate : undefined;
}

/** Whether any playing take has a frame rate. */
export function playsFrames(document: Document): boolean {
  return ratesPlayed(document).some((rate) => rate !== undefined);
}
