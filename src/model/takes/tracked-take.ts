/**
 * Takes whose rotations are still the quaternions of their file. Files of other programs hold dozens of takes, of which
 * few are ever shown, and fitting Euler angles to quaternions takes ten times as long as reading them. So the channels
 * of such a take are made when something first asks for them, whatever it is: playing, an editor, a command, a file.
 *
 * A take is the smallest part that this pays for. Its pose, its keys and its files need all channels of it, and whether
 * one is at rest is only known once it is fitted; were each joint, or each channel, made alone, everything that reads a
 * channel would have to expect one that isn't there yet. So `channels` is a property that is computed once. Only what
 * passes on all that an object holds, without looking at it, has to know (`trackedOf`): messages between worker and
 * page, autosave, and the memory of undo steps.
 */
import type { EulerOrder } from '../skeleton/skeleton.ts';
import type { Channel, Take } from './take.ts';

/** Numbers as a file has them: of single precision, a view of the file's own bytes where they are one list there. */
export type TrackNumbers = Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer>;

/** Rotations over time. Before the first and after the last key it is constant. */
export interface QuaternionTrack {
  /** Ascending seconds; at least one. */
  readonly times: Float64Array<ArrayBuffer>;
  /** x y z w per key, of any length; of `cubic` three times as many: slopes in per second, x y z w, slopes out. */
  readonly values: TrackNumbers;
  /**
   * Up to the next key: `step` holds, `linear` turns along the shortest arc (slerp), `cubic` interpolates components by
   * a Hermite cubic and normalises.
   */
  readonly interpolation: 'step' | 'linear' | 'cubic';
}

/** How a joint's DOFs say a rotation: Euler angles of an order, or the numbers of a quaternion, x y z w. */
export type RotationForm = EulerOrder | 'xyzw';

/** A joint's rotation in a take. */
export interface TrackedRotation {
  readonly track: QuaternionTrack;
  readonly form: RotationForm;
  /** Its DOFs at rest; the first key has those nearest to them. */
  readonly rest: readonly number[];
}

/** One of its DOFs, in the place of its channel. */
export interface TrackedDof {
  readonly kind: 'tracked';
  readonly rotation: TrackedRotation;
  /** Angles are about x, y and z, whatever the order. */
  readonly index: number;
}

/** A take whose channels are yet to be made. Plain data. */
export interface TrackedTake extends Omit<Take, 'channels' | 'samples'> {
  readonly tracked: readonly (Channel | TrackedDof)[];
  /** Fitted keys that its rotations may need beyond the usual, together. */
  readonly spareKeys: number;
}

/** Makes all channels of a take. */
export type MakesChannels = (take: TrackedTake) => readonly Channel[];

const sources = new WeakMap<object, () => TrackedTake | undefined>();

/** The take, whose channels are made when they are first asked for. Copies of it are ordinary takes. */
export function withTracks(take: TrackedTake, make: MakesChannels): Take {
  const { tracked, spareKeys, ...head } = take;
  let source: TrackedTake | undefined = take;
  let channels: readonly Channel[] = [];
  const made: Take = {
    ...head,
    get channels() {
      if (source) {
        channels = make(source);
        source = undefined;
      }
      return channels;
    },
  };
  sources.set(made, () => source);
  return made;
}

/** The source of the channels of a take; undefined once they are made, and for anything else. */
export function trackedOf(value: object): TrackedTake | undefined {
  return sources.get(value)?.();
}

/** The take under another name. Its channels are those of the take, made when either is first asked for them. */
export function renamedTake(take: Take, name: string): Take {
  const source = trackedOf(take);
  return source ? withTracks({ ...source, name }, () => take.channels) : { ...take, name };
}
