/** What looks wrong in a take, and when. */

/**
 * - `spike`: a joint leaves its path for a frame, or jumps and stays.
 * - `jitter`: a joint trembles from frame to frame.
 * - `slide`: a foot that carries the body moves over the ground.
 * - `floor`: a part of the body is below the ground.
 * - `frozen`: no value changes for a while.
 * - `duplicate`: frames repeat the one before, within a movement.
 * - `limit`: a joint is beyond its limits, or an elbow or a knee bends as none can.
 * - `turned`: a foot or a hand points where none can, against the body or up from the floor.
 * - `bone`: a bone changes its length, or differs from that of the other side.
 */
export const FLAG_KINDS = [
  'spike',
  'jitter',
  'slide',
  'floor',
  'frozen',
  'duplicate',
  'limit',
  'turned',
  'bone',
] as const;
export type FlagKind = (typeof FLAG_KINDS)[number];

export interface Flag {
  readonly kind: FlagKind;
  /** First and last second, of the take; the same for what lasts one frame. */
  readonly from: number;
  readonly to: number;
  /** The joint that it is about, if it is about one. */
  readonly joint?: string;
  /**
   * How much: metres; of `frozen` seconds, of `duplicate` the number of frames, of `limit` and `turned` radians.
   */
  readonly amount: number;
}

export type FlagUnit = 'm' | 's' | 'frames' | 'deg';

/** In which unit lists state how much. */
const UNITS: Readonly<Record<FlagKind, FlagUnit>> = {
  spike: 'm',
  jitter: 'm',
  slide: 'm',
  floor: 'm',
  frozen: 's',
  duplicate: 'frames',
  limit: 'deg',
  turned: 'deg',
  bone: 'm',
};

/** Amounts that are equally bad, so that flags of different kinds can be ordered. */
const EQUALLY_BAD: Readonly<Record<FlagKind, number>> = {
  spike: 0.1,
  jitter: 0.01,
  slide: 0.3,
  floor: 0.1,
  frozen: 1,
  duplicate: 5,
  limit: Math.PI / 6,
  turned: Math.PI / 6,
  bone: 0.05,
};

/** How bad it is, comparable between kinds: 1 is, say, a spike of 10 cm. */
export function badness({ kind, amount }: Flag): number {
  return amount / EQUALLY_BAD[kind];
}

/** The amount of a kind that is so bad. */
export function amountOfBadness(kind: FlagKind, bad: number): number {
  return bad * EQUALLY_BAD[kind];
}

/** The worst flag; undefined if there is none. @param kind the worst of these */
export function worstOf(flags: readonly Flag[], kind?: FlagKind): Flag | undefined {
  let worst: Flag | undefined;
  for (const flag of flags) {
    if (kind !== undefined && flag.kind !== kind) continue;
    if (!worst || badness(flag) > badness(worst)) worst = flag;
  }
  return worst;
}

/** The amount in the unit of lists. */
export function statedAmount({ kind, amount }: Flag): { readonly value: number; readonly unit: FlagUnit } {
  const unit = UNITS[kind];
  return { value: unit === 'deg' ? (amount * 180) / Math.PI : amount, unit };
}

/** Flags of one kind beyond this many are counted only: a take with more is wrong everywhere. */
export const MAX_FLAGS = 50;

/** `spike 1.233 LeftHand`, or `slide 2.1-2.65 LeftFoot`: kind, seconds, joint. */
export function flagText({ kind, from, to, joint }: Flag): string {
  const [start, end] = [secondsText(from), secondsText(to)];
  return `${kind} ${start === end ? start : `${start}-${end}`}${joint ? ` ${joint}` : ''}`;
}

function secondsText(seconds: number): string {
  return String(Number(seconds.toFixed(3)));
}
