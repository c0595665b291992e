/** The compared numbers: another program's numbers, each in the place of ours. */
import type { DumpKind } from '../../model/dump.ts';
import type { Goal } from '../ik/goal.ts';
import type { FrameTime } from '../program/evaluator.ts';

/** Numbers of one time. Absent kinds were not in the dumps. */
export interface FrameTarget {
  readonly time: FrameTime;
  /** 16 per joint, column-major. */
  world?: Float64Array;
  local?: Float64Array;
  /** x y z per joint. */
  positions?: Float64Array;
  /** x y z per vertex. */
  vertices?: Float64Array;
  normals?: Float64Array;
  /** The task of inverse kinematics: any pose that reaches these is right, rather than that of the character. */
  readonly solver?: SolverTask;
}

/** The task of a solver of inverse kinematics. */
export interface SolverTask {
  readonly goals: readonly Goal[];
  /** Whether it made one step only. */
  readonly isOneStep: boolean;
}

/** Values of channels: sample i is channel `channels[i]` at `times[i]`. */
export interface ChannelTarget {
  readonly channels: Uint32Array;
  readonly times: Float64Array;
  readonly values: Float64Array;
}

/** How the matrices were written. */
export interface MatrixLayout {
  readonly order: 'row-major' | 'column-major';
  readonly numbers: 12 | 16;
}

/** Another program's numbers, sorted by frame and channel. */
export interface Targets {
  readonly frames: readonly FrameTarget[];
  readonly channels: ChannelTarget;
  /** Layout of the first matrices. */
  readonly layout?: MatrixLayout;
  /** Absent: all are of one dump. */
  readonly origins?: Origins;
}

/** Which dump each list of a frame and each sample is of: indices into the names. */
export interface Origins {
  readonly fileNames: readonly string[];
  /** Per frame. */
  readonly frames: readonly Readonly<Partial<Record<FrameKind, number>>>[];
  readonly samples: Uint32Array;
}

/** The kinds of numbers that belong to a frame. */
export type FrameKind = Exclude<DumpKind, 'channels'>;
/** All kinds of numbers that belong to a frame. */
export const FRAME_KINDS: readonly FrameKind[] = ['world', 'local', 'positions', 'vertices', 'normals'];
