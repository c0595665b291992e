/** The frame rate that the settings of an FBX file state. */
import { statedRate } from '../../evaluate/samples/frame-rate.ts';
import { CUSTOM_RATE, RATES } from '../../formats/fbx/constants.ts';
import type { Properties } from './document.ts';

/** Frames per second that a custom rate can mean. */
const MOST = 10_000;

/** Frames per second; undefined if the file states none. */
export function timeModeRate(settings: Properties): number | undefined {
  const mode = settings.number('TimeMode') ?? 0;
  if (mode !== CUSTOM_RATE) return RATES[mode];
  const rate = settings.number('CustomFrameRate') ?? 0;
  return rate >= 1 && rate <= MOST ? statedRate(rate) : undefined;
}
