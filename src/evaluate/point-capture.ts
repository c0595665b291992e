/** Points over time as a capture without bones: each point is a joint by itself, whose DOFs are where it is. */
import { type Character, shownTake } from '../model/document.ts';
import type { Capture } from '../model/files.ts';
import { type Joint, type Motion, NO_BOX, UNLIMITED } from '../model/skeleton/skeleton.ts';
import { rangeOfSamples, type Samples } from '../model/takes/samples.ts';
import { restChannel, SAMPLED } from '../model/takes/take.ts';
import { eachFrame, type Frames } from './bake.ts';
import { compileSkeleton, worldMatrices } from './kinematics.ts';
import { isVisible } from './visible-points.ts';

/** Labels, and where the points are in every frame. */
export interface PointFrames {
  readonly labels: readonly string[];
  readonly frameCount: number;
  readonly framesPerSecond: number;
  /**
   * Frame by frame, four numbers of each point: x y z, and 1 if it is there, 0 if it is missing, where it stays where
   * it was last.
   */
  readonly values: Float64Array;
}

const POINT: Motion = { kind: 'point' };
const LIMITS = [UNLIMITED, UNLIMITED, UNLIMITED, UNLIMITED];
/** The root translation, which moves all of them. */
const ROOT = 3;

/** A capture of points. Its take shares `values`. @param name of skeleton and take */
export function pointCapture(name: string, { labels, frameCount, framesPerSecond, values }: PointFrames): Capture {
  const joints = labels.map((label, p): Joint => {
    const [x, y, z, valid] = values.subarray(4 * p, 4 * p + 4);
    return {
      name: label,
      parent: -1,
      offset: [x, y, z],
      box: NO_BOX,
      motion: POINT,
      limits: LIMITS,
      pose: [x, y, z, valid],
    };
  });
  const width = 4 * labels.length;
  const samples: Samples = {
    frameCount,
    frameSeconds: 1 / framesPerSecond,
    startSeconds: 0,
    firstChannel: ROOT,
    values,
    scales: new Float64Array(width).fill(1),
    interpolation: 'linear',
  };
  const channels = [
    ...Array.from({ length: ROOT }, () => restChannel(0)),
    ...Array.from({ length: width }, () => SAMPLED),
  ];
  return { skeleton: { name, joints }, take: { name, range: rangeOfSamples(samples), channels, samples } };
}

/**
 * The capture of a character of points, with its shown take at such frames: where its points are, however it is driven.
 * @throws Error without a skeleton
 */
export function bakedPoints(character: Character, frames: Frames): Capture {
  const { skeleton } = character;
  if (!skeleton) throw new Error(`${character.name} has no points.`);
  const compiled = compileSkeleton(skeleton);
  const count = skeleton.joints.length;
  const values = new Float64Array(4 * count * frames.frameCount);
  const world = new Float64Array(16 * count);
  eachFrame(character, frames, (dofs, frame) => {
    worldMatrices(compiled, dofs, world);
    for (let p = 0, at = 4 * count * frame; p < count; p++, at += 4) {
      for (let k = 0; k < 3; k++) values[at + k] = world[16 * p + 12 + k];
      values[at + 3] = isVisible(compiled, p, dofs) ? 1 : 0;
    }
  });
  const labels = skeleton.joints.map(({ name }) => name);
  const framesPerSecond = 1 / frames.frameSeconds;
  return pointCapture(shownTake(character)?.name ?? skeleton.name, {
    labels,
    frameCount: frames.frameCount,
    framesPerSecond,
    values,
  });
}
