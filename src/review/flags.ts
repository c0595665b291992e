/** What looks wrong in a take, and when. */

/**
 * - `spike`: a joint leaves its path for a frame, or jumps and stays.
 * - `jitter`: a joint trembles from frame to frame.
 * - `slide`: a foot that carries the body moves over the ground.
 * - `floor`: a part of the body is below the ground.
 * - `frozen`: no value changes for a while.
 * - `duplicate`: frames repeat the one before, within a movement.
 * - `limit`: a joint is beyond its limits, or an elbow or a knee bends as none can.
 * - `bone`: a bone changes its length, or differs from that of the other side.
 */
export const FLAG_KINDS = ['spike', 'jitter', 'slide', 'floor', 'frozen', 'duplicate', 'limit', 'bone'] as const;
export type FlagKind = (typeof FLAG_KINDS)[number];

export interface Flag {
  readonly kind: FlagKind;
  /** First and last second, of the clip; the same for what lasts one frame. */
  readonly from: number;
  readonly to: number;
  /** The joint that it is about, if it is about one. */
  readonly joint?: string;
  /**
   * How much: metres; of `frozen` seconds, of `duplicate` the number of frames, of `limit` radians.
   */
  readonly amount: number;
}

/** Flags of one kind beyond this many are counted only: a take with more is wrong everywhere. */
export const MOST_FLAGS = 50;

/** `spike 1.233 LeftHand`, or `slide 2.1-2.65 LeftFoot`: kind, seconds, joint. */
export function flagText({ kind, from, to, joint }: Flag): string {
  const [start, end] = [secondsText(from), secondsText(to)];
  return `${kind} ${start === end ? start : `${start}-${end}`}${joint ? ` ${joint}` : ''}`;
}

function secondsText(seconds: number): string {
  return String(Number(seconds.toFixed(3)));
}
