/** What a list says about a take without anybody having looked at it. */
import { frameRateOf } from '../evaluate/samples/frame-rate.ts';
import { framesOfClip } from '../evaluate/samples/key-frames.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Space } from '../model/space.ts';
import type { ChannelClip } from '../model/takes/clip.ts';
import { checkTake } from './check-take.ts';
import { KEYED_RATE } from './frames.ts';
import type { TakeFacts } from './list.ts';

export function takeFacts(skeleton: Skeleton, clip: ChannelClip, space: Space | undefined): TakeFacts {
  const seconds = clip.range[1] - clip.range[0];
  const fps = frameRateOf(clip) ?? KEYED_RATE;
  const frames = framesOfClip(clip, KEYED_RATE).frameCount;
  return { frames, fps, seconds, joints: skeleton.joints.length, flags: checkTake(skeleton, clip, space) };
}
