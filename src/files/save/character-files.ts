/**
 * Converts a character to formats other than its own: BVH to `.skel` and `.anim`, any to `.bvh`. Page and command share
 * these models; the writers make text of them.
 */

import { CommandError } from '../../edit/command-error.ts';
import type { SampleKeyOptions } from '../../edit/convert/keys-of-samples.ts';
import { skelForm, skelPose, skelTake } from '../../edit/convert/skel-form.ts';
import { toAcclaimBones } from '../../evaluate/acclaim-bones.ts';
import { type Frames, framesOf, MAX_FRAMES, ownFrames, playedTake } from '../../evaluate/bake.ts';
import type { BvhCapture } from '../../evaluate/bvh-capture.ts';
import { framesFor, toBvhCapture } from '../../evaluate/bvh-capture.ts';
import { bakedPoints } from '../../evaluate/point-capture.ts';
import { frameRateOf } from '../../evaluate/samples/frame-rate.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { type Character, isOfJoints } from '../../model/document.ts';
import type { Capture } from '../../model/files.ts';
import { filePose } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { type Take, USUAL_FRAMES_PER_SECOND } from '../../model/takes/take.ts';

/** The character's skeleton as `.skel` can hold it, in its current pose as set. Undefined without a skeleton. */
export function skelOf({ skeleton, pose }: Pick<Character, 'skeleton' | 'pose'>): Skeleton | undefined {
  return skeleton && inPose(skelForm(skeleton).skeleton, skelPose(pose, skeleton));
}

/** One of its takes as `.anim` can hold it: keys for the DOFs of `skelOf`. */
export function animOf({ skeleton }: Pick<Character, 'skeleton'>, take: Take, options?: SampleKeyOptions): Take {
  return skeleton ? skelTake(take, skeleton, options) : take;
}

/** A take as a BVH capture, with the name of its file without extension. */
export interface NamedCapture extends BvhCapture {
  readonly name: string;
}

/**
 * A BVH capture for each take, or one in the pose as set if there are none. Throws a `CommandError` if there are too
 * many frames to sample.
 * @param framesPerSecond for all takes; absent: each take's own (of its samples or evenly spaced keys), or else 30,
 * which is reported
 */
export function bvhOf(character: Character, framesPerSecond?: number): readonly NamedCapture[] {
  return takesOf(character, framesPerSecond, toBvhCapture, 'bvh');
}

/**
 * Each of its takes as one of Acclaim bones, which a character that consists of them keeps; options and errors as of
 * `bvhOf`.
 */
export function acclaimOf(character: Character, framesPerSecond?: number): readonly NamedCapture[] {
  return takesOf(character, framesPerSecond, toAcclaimBones, 'amc');
}

/**
 * A character of Acclaim bones as motion capture, whose joints other formats can hold; any other character itself.
 * Throws as `bvhOf`.
 */
export function withoutBones(character: Character): Character {
  if (!isOfJoints(character, 'asf')) return character;
  const captured = bvhOf(character).map((made) => made.capture);
  const [{ skeleton }] = captured;
  return {
    ...character,
    skeleton,
    takes: captured.flatMap(({ take }) => take ?? []).slice(0, character.takes.length),
    pose: filePose(skeleton, character.morphs.length),
  };
}

/** A take of points as its frames have it, whatever drives it; without a take the pose. @throws CommandError as `bvhOf` */
export function pointsOf({ driver: _, ...character }: Character, take: Take | undefined): Capture {
  const shown = { ...character, takes: take ? [take] : [], shownTake: take ? 0 : -1 };
  const [made] = takesOf(
    shown,
    undefined,
    (each, frames) => ({ capture: bakedPoints(each, frames), diagnostics: [] }),
    'trc',
  );
  return made.capture;
}

type Conversion = (character: Character, frames: Frames, file: string) => BvhCapture;

function takesOf(
  character: Character,
  framesPerSecond: number | undefined,
  convert: Conversion,
  extension: string,
): readonly NamedCapture[] {
  const { skeleton, takes, driver } = character;
  if (!skeleton) return [];
  const named = (of: Character, name: string) => namedTake(of, framesPerSecond, name, convert, extension);
  // The retargeted take, whichever of its own is shown.
  if (driver) return [named(character, `${skeleton.name}_${driver.source.take.name}`)];
  if (takes.length === 0) return [named({ ...character, shownTake: -1 }, skeleton.name)];
  return takes.map((take, index) => named({ ...character, shownTake: index }, take.name));
}

function namedTake(
  character: Character,
  framesPerSecond: number | undefined,
  name: string,
  convert: Conversion,
  extension: string,
): NamedCapture {
  const take = playedTake(character);
  const frames =
    framesPerSecond === undefined
      ? framesFor(character, USUAL_FRAMES_PER_SECOND)
      : framesOf(take?.range ?? [0, 0], framesPerSecond);
  if (frames.frameCount > Math.max(MAX_FRAMES, ownFrames(character)?.frameCount ?? 0)) {
    const count = frames.frameCount.toLocaleString('en');
    throw new CommandError(
      `${name} would have ${count} frames, but the maximum is ${MAX_FRAMES.toLocaleString('en')}.`,
    );
  }
  const made = convert(character, frames, `${name}.${extension}`);
  const isAssumed = framesPerSecond === undefined && take !== undefined && !hasOwnRate(take) && frames.frameCount > 1;
  return {
    name,
    ...made,
    diagnostics: isAssumed ? [rateAssumed(take, `${name}.${extension}`), ...made.diagnostics] : made.diagnostics,
  };
}

/** Whether a take has a frame rate of its own. */
export function hasOwnRate(take: Take): boolean {
  return frameRateOf(take) !== undefined;
}

function rateAssumed(take: Take, file: string): Diagnostic {
  const message = `Expected keys at an even rate or a frame rate for ${take.name}, found keys at uneven times.`;
  return withoutPlace('info', 'rate-assumed', message, file, `used ${USUAL_FRAMES_PER_SECOND} frames per second`);
}

/**
 * The skeleton with this pose as its file pose.
 * @param pose one value per DOF of the joints
 */
export function inPose(skeleton: Skeleton, pose: readonly number[]): Skeleton {
  let start = 0;
  const joints = skeleton.joints.map((joint) => {
    const from = start;
    start += dofsOf(joint.motion).length;
    return { ...joint, pose: pose.slice(from, start) };
  });
  return { ...skeleton, joints };
}
