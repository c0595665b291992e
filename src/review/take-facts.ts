/** What a list says about a take without anybody having looked at it. */
import type { ChannelClip } from '../model/clip.ts';
import type { Skeleton } from '../model/skeleton.ts';
import type { Space } from '../model/space.ts';
import { checkTake } from './check-take.ts';
import type { TakeFacts } from './list.ts';

/** Frames per second at which a take of keys is counted. */
const RATE = 60;

export function takeFacts(skeleton: Skeleton, clip: ChannelClip, space: Space | undefined): TakeFacts {
  const { samples, range } = clip;
  const seconds = range[1] - range[0];
  const fps = samples ? 1 / samples.frameSeconds : RATE;
  const frames = samples?.frameCount ?? Math.round(seconds * fps) + 1;
  return { frames, fps, seconds, joints: skeleton.joints.length, flags: checkTake(skeleton, clip, space) };
}
