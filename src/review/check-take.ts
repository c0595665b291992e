/**
 * What looks wrong in a take: one pass over its frames, in metres, with all checks at once. They are `checks/`, each
 * with its thresholds; what they find is a hint to look, not a judgement.
 */
import { metresPerUnit } from '../evaluate/metres.ts';
import type { ChannelClip } from '../model/clip.ts';
import type { Skeleton } from '../model/skeleton.ts';
import { DEFAULT_SPACE, type Space } from '../model/space.ts';
import { Bones } from './checks/bones.ts';
import { FootSliding } from './checks/feet.ts';
import { Floor } from './checks/floor.ts';
import { Jitter } from './checks/jitter.ts';
import { Limits } from './checks/limits.ts';
import { Spikes } from './checks/spikes.ts';
import { stillFrames } from './checks/still.ts';
import type { Flag } from './flags.ts';
import { takeFrames } from './frames.ts';
import { survey } from './survey.ts';

/**
 * In order of time.
 * @param space as guessed or set; lengths are meaningless without
 */
export function checkTake(skeleton: Skeleton, clip: ChannelClip, space: Space = DEFAULT_SPACE): readonly Flag[] {
  if (skeleton.joints.length === 0) return [];
  const frames = takeFrames(skeleton, clip, space);
  const surveyed = survey(frames, space);
  const checks = [
    new Spikes(frames),
    new Jitter(frames),
    new FootSliding(frames, surveyed),
    new Floor(frames),
    new Limits(frames, surveyed, metresPerUnit(space)),
    new Bones(frames, surveyed),
  ];
  const dofs = new Float64Array(frames.dofCount);
  const points = new Float64Array(3 * frames.pointCount);
  for (let f = 0; f < frames.count; f++) {
    frames.write(f, dofs, points);
    for (const check of checks) check.frame(f, points, dofs);
  }
  return [...checks.flatMap((check) => check.end()), ...stillFrames(frames)].sort((a, b) => a.from - b.from);
}
