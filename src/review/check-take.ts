/**
 * What looks wrong in a take: one pass over its frames, in metres, with all checks at once. They are `checks/`, each
 * with its thresholds; what they find is a hint to look, not a judgement.
 */
import { metresPerUnit } from '../evaluate/space/metres.ts';
import { runToEnd, type Steps } from '../evaluate/steps.ts';
import type { Character } from '../model/document.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import { DEFAULT_SPACE, type Space } from '../model/space.ts';
import type { Take } from '../model/takes/take.ts';
import { Bones } from './checks/bones.ts';
import type { Check } from './checks/check.ts';
import { Deviations } from './checks/deviations.ts';
import { FootSliding } from './checks/feet.ts';
import { Floor } from './checks/floor.ts';
import { Jitter } from './checks/jitter.ts';
import { Limits } from './checks/limits.ts';
import { Spikes } from './checks/spikes.ts';
import { stillFrames } from './checks/still.ts';
import { Turned } from './checks/turned.ts';
import type { Flag } from './flags.ts';
import { displayedFrames, type TakeFrames, takeFrames } from './frames.ts';
import { survey } from './survey.ts';

/** The checks of one take, for whoever has its frames already. */
export class TakeCheck {
  private readonly deviations: Deviations;
  private readonly checks: readonly Check[];

  /** @param space of the frames */
  constructor(
    readonly frames: TakeFrames,
    space: Space = DEFAULT_SPACE,
  ) {
    const surveyed = survey(frames, space);
    this.deviations = new Deviations(frames.pointCount);
    this.checks = [
      new Spikes(frames, this.deviations),
      new Jitter(frames, this.deviations),
      new FootSliding(frames, surveyed),
      new Floor(frames),
      new Limits(frames, surveyed, metresPerUnit(space)),
      new Turned(frames, surveyed),
      new Bones(frames, surveyed),
    ];
  }

  /** Frames come in order. @param points as `TakeFrames.write` writes them */
  frame(frame: number, dofs: Float64Array, points: Float64Array): void {
    this.deviations.push(points);
    for (const check of this.checks) check.frame(frame, points, dofs);
  }

  /** After the last frame: flags in order of time. */
  end(): readonly Flag[] {
    const flags = [...this.checks.flatMap((check) => check.end()), ...stillFrames(this.frames)];
    return flags.sort((a, b) => a.from - b.from);
  }
}

/**
 * In order of time.
 * @param space as guessed or set; lengths are meaningless without
 */
export function checkTake(skeleton: Skeleton, take: Take, space: Space = DEFAULT_SPACE): readonly Flag[] {
  if (skeleton.joints.length === 0) return [];
  return runToEnd(checking(takeFrames(skeleton, take, space), space));
}

/**
 * The same of what a character plays, as displayed, retargeted takes too; in seconds of the take that plays. Yields
 * progress, 0 to 1. None without a take.
 */
export function* checkDisplayed(character: Character): Steps<readonly Flag[]> {
  const frames = displayedFrames(character);
  return frames && frames.skeleton.joints.length > 0 ? yield* checking(frames, character.space) : [];
}

/** Frames between two progress reports, a few milliseconds at most. */
const FRAMES_AT_A_TIME = 32;

function* checking(frames: TakeFrames, space: Space = DEFAULT_SPACE): Steps<readonly Flag[]> {
  const check = new TakeCheck(frames, space);
  const dofs = new Float64Array(frames.dofCount);
  const points = new Float64Array(3 * frames.pointCount);
  for (let f = 0; f < frames.count; f++) {
    if (f % FRAMES_AT_A_TIME === 0) yield f / frames.count;
    frames.write(f, dofs, points);
    check.frame(f, dofs, points);
  }
  return check.end();
}
