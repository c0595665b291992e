/**
 * How a character is posed that another's take moves. What does that (`retarget/`) is a script of its own, since few
 * pages ever need it; posing is not to wait for one. So whoever brings a driver into a document brings it along:
 *
 *     import '…/evaluate/retarget/driving.ts';
 *
 * as the commands about takes on other characters and the reader of kept sessions do.
 */
import type { Character, Driver } from '../model/document.ts';
import type { Skeleton } from '../model/skeleton.ts';

/** Writes the DOFs that the driver has the say over; the others of the joints are the pose's. Seconds of the transport. */
export type DrivenPose = (
  character: Character,
  driver: Driver,
  skeleton: Skeleton,
  timeSeconds: number,
  out: Float64Array,
) => void;

let provided: DrivenPose | undefined;

export function provideDrivenPose(pose: DrivenPose): void {
  provided = pose;
}

/** @throws Error where nothing was brought along */
export const drivenPose: DrivenPose = (character, driver, skeleton, timeSeconds, out) => {
  if (!provided) throw new Error(`${character.name} is moved by another's take, but the code for that is not loaded.`);
  provided(character, driver, skeleton, timeSeconds, out);
};
