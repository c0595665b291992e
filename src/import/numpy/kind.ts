/** A kind of arrays: what tells that a file is one, and what reads it. */
import type { FrameJoints, JointFrames } from '../../evaluate/captured-frames.ts';
import type { PointFrames } from '../../evaluate/point-capture.ts';
import type { FileSpace } from '../../model/space.ts';
import type { Remarks } from '../imported.ts';
import type { Arrays } from './npz.ts';

/** Joints with their motion, or points. */
export type ReadMotion = (ReadJoints | { readonly points: PointFrames }) & ReadSpace;

/** Joints with their motion. */
export interface ReadJoints {
  readonly joints: FrameJoints;
  readonly frames: JointFrames;
}

/** What is known of the space of a motion, and of its reading. */
interface ReadSpace {
  /** What the file, or its kind, states; absent: it is guessed, but for what `up` says. */
  readonly space?: FileSpace;
  /** Of a space whose ground, or all but this, is guessed. */
  readonly up?: 'y' | 'z';
  /** Whether y points down, as in pictures: then the rest is guessed. */
  readonly isDown?: boolean;
  /** What there is to say once all frames are written. */
  readonly told?: () => void;
}

/** A kind of arrays. */
export interface ArraysKind {
  /** For messages: what is read, by its arrays. */
  readonly says: string;
  /** Whether a file is one, by names and shapes. */
  is(arrays: Arrays): boolean;
  /** Reads it. @throws ImportError if the arrays don't fit each other */
  read(arrays: Arrays, remarks: Remarks): ReadMotion;
}
