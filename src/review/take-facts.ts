/** What a list says about a take without anybody having looked at it. */
import { frameRateOf } from '../evaluate/samples/frame-rate.ts';
import { framesOfTake } from '../evaluate/samples/key-frames.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Space } from '../model/space.ts';
import type { Take } from '../model/takes/take.ts';
import { checkTake } from './check-take.ts';
import { KEYED_RATE } from './frames.ts';
import type { TakeFacts } from './list.ts';

export function takeFacts(skeleton: Skeleton, take: Take, space: Space | undefined): TakeFacts {
  const seconds = take.range[1] - take.range[0];
  const fps = frameRateOf(take) ?? KEYED_RATE;
  const frames = framesOfTake(take, KEYED_RATE).frameCount;
  return { frames, fps, seconds, joints: skeleton.joints.length, flags: checkTake(skeleton, take, space) };
}
