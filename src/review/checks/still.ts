/**
 * Frames without movement, by the values as the file has them. A frame that repeats the one before is a `duplicate`
 * within a movement, and `frozen` from 0.3 s on. A take that holds still is `frozen` only where it moves before and
 * after, or for more than half of it: recordings begin and end with held poses.
 */
import type { Samples } from '../../model/takes/samples.ts';
import type { Flag } from '../flags.ts';
import type { TakeFrames } from '../frames.ts';
import { flagOf, largest } from './check.ts';

const FROZEN_SECONDS = 0.3;
const FROZEN_FRAMES = 4;
/** Duplicates this many frames apart at most are one flag: takes with doubled frames have them throughout. */
const APART = 8;

/** Of takes with samples; keys hold still as meant. */
export function stillFrames(frames: TakeFrames): readonly Flag[] {
  const { samples } = frames.take;
  if (!samples || samples.scales.length === 0) return [];
  const flags: Flag[] = [];
  const shortest = Math.max(FROZEN_FRAMES, Math.round(FROZEN_SECONDS / frames.frameSeconds));
  /** First frame of the run of equal ones. */
  let start = 0;
  let first = -1;
  let last = -1;
  let count = 0;
  const duplicates = () => {
    if (first >= 0) flags.push(flagOf(frames, 'duplicate', first, last, count));
    first = -1;
    count = 0;
  };
  const { frameCount } = samples;
  for (let f = 1; f <= frameCount; f++) {
    if (f < frameCount && isSame(samples, f)) continue;
    const repeats = f - 1 - start;
    const isWithin = start > 0 && f < frameCount;
    if (repeats >= shortest) {
      if (isWithin) {
        duplicates();
        flags.push(flagOf(frames, 'frozen', start, f - 1, repeats * frames.frameSeconds));
      }
    } else if (repeats > 0 && isWithin) {
      if (first >= 0 && start + 1 - last > APART) duplicates();
      if (first < 0) first = start + 1;
      last = f - 1;
      count += repeats;
    }
    start = f;
  }
  duplicates();
  return largest(flags);
}

function isSame({ values, scales }: Samples, frame: number): boolean {
  const width = scales.length;
  const a = frame * width;
  for (let k = a; k < a + width; k++) if (values[k] !== values[k - width]) return false;
  return true;
}
