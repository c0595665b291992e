/** Limits the number of frames to what a page can hold. */
import { MAX_FRAMES, MAX_VALUES } from '../../evaluate/bake.ts';
import { CommandError } from '../command-error.ts';

/**
 * Refuses, in a sentence, more frames or values than can be held.
 * @param width channels per frame
 * @param there existing frames, whose number is always allowed
 */
export function refuseTooMany(frameCount: number, width: number, there = 0): void {
  if (frameCount <= there) return;
  const most = Math.min(MAX_FRAMES, Math.floor(MAX_VALUES / Math.max(1, width)));
  if (frameCount <= most) return;
  const [asked, possible] = [frameCount, most].map((count) => count.toLocaleString('en'));
  throw new CommandError(`That would be ${asked} frames of ${width} channels, but the maximum is ${possible} frames.`);
}
