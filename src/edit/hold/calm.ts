/**
 * If a pin is out of reach, the nearest pose stretches the whole chain, which was bent a moment before: following it
 * exactly would be a jerk. Since no pin is at its target then anyway, the changes of such frames are limited in speed,
 * from the frame before and to the one after.
 */
import { applyConstraints, type CompiledSkeleton } from '../../evaluate/kinematics.ts';
import type { HeldFrames } from './frames.ts';

/** Radians and reaches per second: about as fast as people and animals move. */
const FASTEST = 4;

/**
 * In place, for frames that are not reached; others are left alone.
 * @param units by DOF: value of 1 in radians, reaches etc.
 */
export function calm(
  { own, held, width, isReached }: HeldFrames,
  times: Float64Array,
  units: ArrayLike<number>,
  compiled: CompiledSkeleton,
  clamps: boolean,
): void {
  const follow = (f: number, other: number) => {
    if (isReached[f]) return;
    const [o, p] = [f * width, other * width];
    let fastest = 0;
    for (let d = 0; d < width; d++) {
      const difference = held[o + d] - own[o + d] - (held[p + d] - own[p + d]);
      fastest = Math.max(fastest, Math.abs(difference) * units[d]);
    }
    const most = FASTEST * Math.abs(times[f] - times[other]);
    if (!(fastest > most)) return;
    const part = most / fastest;
    for (let d = 0; d < width; d++) {
      const change = held[p + d] - own[p + d];
      held[o + d] = own[o + d] + change + part * (held[o + d] - own[o + d] - change);
    }
    applyConstraints(compiled, held.subarray(o, o + width), clamps);
  };
  for (let f = 1; f < times.length; f++) follow(f, f - 1);
  for (let f = times.length - 2; f >= 0; f--) follow(f, f + 1);
}
