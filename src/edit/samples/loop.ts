/**
 * Makes a take loop: its end is cross-faded into its beginning, of the whole body.
 *
 *     frames   0 ……… W ………………… n−W ……… n          out   0 ……… W ………………… n−W
 *              ╱╱╱╱╱ own                              ╲╲╲╲╲ of the end, carried to the beginning
 *
 * The result begins with the pose of frame n−W, which its last frame shows again, and continues from it as the take
 * does: pose and speed are continuous. A root that travels is carried back by its way, so that every round continues
 * from the one before; one that returns, or turns by little, is blended.
 */
import type { Steps } from '../../evaluate/steps.ts';
import { smoothstep } from '../../math/smoothstep.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';
import type { Samples } from '../../model/takes/samples.ts';
import type { Take } from '../../model/takes/take.ts';
import { CommandError } from '../command-error.ts';
import { blendPoses } from './blend-frames.ts';
import { Carrier, type Carry, isCarried, STAYS } from './carry.ts';
import type { Joining } from './join.ts';
import { jointRotations } from './rotations.ts';
import { readFrame, writeFrame } from './take-frames.ts';

/** Radians: a smaller turn from the beginning to the end is no curve, and blended. */
const STRAIGHT = Math.PI / 18;
/** First and last frame this near to each other, in sizes of a matrix entry, are one pose. */
const SAME_POSE = 1e-6;
const STEP_FRAMES = 256;

/**
 * The frames of one round, the last of which is the first again; the same samples if they loop already.
 * @param overlap frames that are blended; from 1 to half of all. Refuses more.
 */
export function* looping(
  { character, take }: Pick<Joining, 'character'> & { readonly take: Take },
  samples: Samples,
  overlap: number,
): Steps<Samples> {
  const { frameCount } = samples;
  const { skeleton, morphs, space } = character;
  const carrier = new Carrier(skeleton, take, space?.up ?? 'y');
  if (loops(carrier, samples)) return samples;
  const last = frameCount - overlap;
  if (overlap < 1 || last < overlap) {
    throw new CommandError(`The blend must be from 1 to ${Math.floor(frameCount / 2)} frames long, found ${overlap}.`);
  }
  const middle = Math.floor(overlap / 2);
  const carry = carryBetween(carrier, samples, last + middle, middle);
  const out: Samples = {
    ...samples,
    frameCount: last + 1,
    values: samples.values.slice(0, (last + 1) * samples.scales.length),
  };
  const dofs = characterDofs(skeleton, morphs);
  const count = Math.min(dofs.length, samples.scales.length);
  const rotations = jointRotations(skeleton);
  const [own, theirs, before, mixed] = [0, 1, 2, 3].map(() => new Float64Array(count));
  const previous = new Float64Array(count);
  readFrame(samples, last, before);
  readFrame(samples, 0, previous);
  for (let f = 0; f < overlap; f++) {
    readFrame(samples, f, own);
    readFrame(samples, last + f, theirs);
    if (isCarried(carry)) carrier.carry(carry, theirs, before);
    before.set(theirs);
    blendPoses(dofs, rotations, theirs, own, smoothstep(0, overlap, f), previous, mixed);
    writeFrame(out, f, mixed);
    previous.set(mixed);
    if (f % STEP_FRAMES === STEP_FRAMES - 1) yield f / overlap;
  }
  return out;
}

/** The carry that takes the stance of one frame to that of another. */
function carryBetween(carrier: Carrier, samples: Samples, from: number, to: number): Carry {
  const pose = new Float64Array(samples.scales.length);
  const stanceAt = (frame: number) => {
    readFrame(samples, frame, pose);
    return carrier.stanceOf(pose);
  };
  const [a, b] = [stanceAt(from), stanceAt(to)];
  const turned = carrier.turnBetween(b, a);
  const turn = Math.abs(turned) > STRAIGHT ? turned : 0;
  const way = Math.hypot(...[0, 1, 2].map((k) => (k === carrier.up ? 0 : b.place[k] - a.place[k])));
  if (turn === 0 && way <= extentOf(carrier, samples, pose) / 2) return STAYS;
  return carrier.over(turn, a.place, b.place);
}

/** How far the body gets over the ground, corner to corner. */
function extentOf(carrier: Carrier, samples: Samples, pose: Float64Array): number {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  // Every frame of a long take would take as long as the blend.
  const step = Math.max(1, Math.floor(samples.frameCount / 128));
  for (let f = 0; f < samples.frameCount; f += step) {
    readFrame(samples, f, pose);
    carrier.stanceOf(pose).place.forEach((v, k) => {
      min[k] = Math.min(min[k], v);
      max[k] = Math.max(max[k], v);
    });
  }
  return Math.hypot(...[0, 1, 2].map((k) => (k === carrier.up ? 0 : max[k] - min[k])));
}

/** Whether the last frame shows the pose of the first. */
function loops(carrier: Carrier, samples: Samples): boolean {
  if (samples.frameCount < 2) return true;
  const carry = carryBetween(carrier, samples, samples.frameCount - 1, 0);
  const pose = new Float64Array(samples.scales.length);
  readFrame(samples, 0, pose);
  const first = carrier.worldOf(pose).slice();
  const previous = pose.slice();
  readFrame(samples, samples.frameCount - 1, pose);
  if (isCarried(carry)) carrier.carry(carry, pose, previous);
  const size = first.reduce((most, v) => Math.max(most, Math.abs(v)), 1);
  return carrier.worldOf(pose).every((v, k) => Math.abs(v - first[k]) <= SAME_POSE * size);
}
