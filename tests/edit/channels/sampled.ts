/** Measuring by brute force, independently of how the code does it. */
import { compileChannels } from '../../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../src/evaluate/curves.ts';
import type { Channel } from '../../../src/model/takes/take.ts';

/** The largest difference of two channels at even times, leaving out both ends. */
export function largestSampled(a: Channel, b: Channel, from: number, to: number, count: number): number {
  const both = compileChannels([a, b]);
  let largest = 0;
  for (let i = 0; i < count; i++) {
    const t = from + ((i + 0.4142) / count) * (to - from);
    largest = Math.max(largest, Math.abs(evaluateChannel(both, 0, t) - evaluateChannel(both, 1, t)));
  }
  return largest;
}
