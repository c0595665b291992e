/**
 * A dump: numbers that another program printed about a character, in the order of its file. Which joints, vertices or
 * channels they are is decided with a character available (`teaching/dump/fit-dump.ts`); here is only what the file
 * says.
 */
import type { Vec3 } from '../math/vec3.ts';

/** Kinds of numbers that a dump can hold. Positions are those of joints. */
export const DUMP_KINDS = ['world', 'local', 'positions', 'vertices', 'normals', 'channels'] as const;
/** Kind of the numbers in a block; see `DUMP_KINDS`. */
export type DumpKind = (typeof DUMP_KINDS)[number];

/** The numbers of one dump, in blocks, with what the file says about their time and purpose. */
export interface Dump {
  /** Without folders and extension. */
  readonly name: string;
  /** Seconds, from the name: `walk@1.5.txt`. */
  readonly time?: number;
  /** Empty if the file has no numbers that could be of a character. */
  readonly blocks: readonly DumpBlock[];
  /** Lines with numbers that were taken for headings; absent if there are none. */
  readonly headings?: readonly DumpHeading[];
  /** Targets of inverse kinematics: its joints are right wherever these are reached; absent if there are none. */
  readonly targets?: readonly DumpTarget[];
  /** Whether it says that its solver made one step. */
  readonly isOneStep?: true;
}

/** Where a solver of inverse kinematics shall bring a point of a joint: `target hand 0.3 1.2 0`. */
export interface DumpTarget {
  /** The joint, as printed; null if it isn't said. */
  readonly of: DumpLabel | null;
  /** In the joint's space; absent: its tip, or its origin. */
  readonly point?: Vec3;
  /** In the space of the world matrices. */
  readonly position: Vec3;
  /** Seconds, as stated above it; absent: of all numbers. */
  readonly time?: number;
  /** From 1. */
  readonly line: number;
}

/** A line whose numbers are no values: `Project 3`. */
export interface DumpHeading {
  /** From 1. */
  readonly line: number;
  /** How many it has. */
  readonly numbers: number;
}

/** Whether a file that could be a dump by its name has no numbers for one, as a readme. */
export function isEmptyDump(content: { readonly kind: string; readonly dump?: Dump }): boolean {
  return content.kind === 'dump' && content.dump?.blocks.length === 0;
}

/** The message about an empty dump. */
export function emptyDumpMessage(bytes: number): string {
  const found = bytes === 0 ? 'an empty file' : 'a file without them';
  return `Expected numbers of joints, vertices or channels, found ${found}.`;
}

/** Consecutive numbers of one kind, at one time. */
export interface DumpBlock {
  /** As stated by a heading, a key or the format; absent: to be told from the numbers. */
  readonly holds?: DumpKind;
  /** Seconds, as stated. */
  readonly time?: number;
  /** The channel of a block headed `channel N`. */
  readonly channel?: number;
  /** Times of the values of each channel, if stated apart from them. */
  readonly times?: Float64Array;
  /** Names of columns, one per number of a row; those of labels are left out. */
  readonly columns?: readonly string[];
  /** How matrices are nested in JSON: 16 numbers in one list, or a list of rows. */
  readonly nesting?: 'flat' | 'rows';
  /** All numbers; NaN and infinities are kept, since programs print them. */
  readonly values: Float64Array;
  /** Row r has the values `starts[r]` up to (excluding) `starts[r + 1]`; one more than rows. */
  readonly starts: Uint32Array;
  /** Line of each row, from 1. */
  readonly lines: Uint32Array;
  /** One per row, if any has one. A row without a label continues the one before. */
  readonly labels?: readonly (DumpLabel | null)[];
}

/** At least one of them. */
export interface DumpLabel {
  /** As printed: of a joint, vertex or channel, or the time of a row of values. */
  readonly index?: number;
  readonly name?: string;
}

/** Whether nothing states when its numbers are. Channels have times of their own. */
export function isUntimed({ time, times, channel, holds, columns }: DumpBlock): boolean {
  const isOfTimes = columns?.some((name) => /^(time|t|seconds)$/.test(name)) ?? false;
  return time === undefined && times === undefined && channel === undefined && holds !== 'channels' && !isOfTimes;
}
