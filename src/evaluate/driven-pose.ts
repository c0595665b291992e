/**
 * Posing a character that another's take drives. Retargeting (`retarget/`) is a separate script, since few pages need
 * it, but posing must not wait for it to load. So code that adds a driver to a document, or is given characters that
 * may have one or follow one that has, passes it on:
 *
 *     provideRetargeting();
 *
 * of `retarget/driving.ts`. The commands for retargeting, the session reader and the worker's writers do.
 */
import type { Character, Driver } from '../model/document.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';

/** Writes the DOFs that the driver controls; the joints' other DOFs come from the pose. Seconds of the transport. */
export type DrivenPose = (
  character: Character,
  driver: Driver,
  skeleton: Skeleton,
  timeSeconds: number,
  out: Float64Array,
) => void;

let provided: DrivenPose | undefined;

/** Passes on the function that `drivenPose` calls, before there is a driver. */
export function provideDrivenPose(pose: DrivenPose): void {
  provided = pose;
}

/**
 * Poses a character by its driver, with the function that was provided.
 * @throws Error if none was
 */
export const drivenPose: DrivenPose = (character, driver, skeleton, timeSeconds, out) => {
  if (!provided) throw new Error(`${character.name} is moved by another's take, but the code for that is not loaded.`);
  provided(character, driver, skeleton, timeSeconds, out);
};
