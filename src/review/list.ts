/** A list of takes with what a person thinks of them: its rows, whatever they are written as. */
import type { Review, ReviewedTake } from '../model/takes/review.ts';
import { type Flag, flagText, statedAmount, worstOf } from './flags.ts';

/** A take in a list. Lists written by hand may lack everything but the path. */
export interface ListedTake extends ReviewedTake {
  readonly frames?: number;
  /** Frames per second. */
  readonly fps?: number;
  readonly seconds?: number;
  readonly joints?: number;
  /** How large the worst flag is, in `unit`, and of which `kind` it is; absent without flags. */
  readonly worst?: number;
  readonly unit?: string;
  readonly kind?: string;
  /** As `flagText` writes them; absent if the take was not checked. */
  readonly flags?: readonly string[];
}

/** The columns of a list, in order. */
export const LIST_COLUMNS = [
  'path',
  'verdict',
  'stars',
  'tags',
  'notes',
  'frames',
  'fps',
  'seconds',
  'joints',
  'worst',
  'unit',
  'kind',
  'flags',
] as const;
export type ListColumn = (typeof LIST_COLUMNS)[number];

/** Facts of a take, for its row. */
export interface TakeFacts {
  readonly frames: number;
  readonly fps: number;
  readonly seconds: number;
  readonly joints: number;
  readonly flags: readonly Flag[];
}

export function listedTake(path: string, review: Review, facts: TakeFacts | undefined): ListedTake {
  const { verdict, stars, tags, notes } = review;
  if (!facts) return { path, verdict, stars, tags, notes };
  const { frames, fps, seconds, joints, flags } = facts;
  const counts = { frames, fps: rounded(fps), seconds: rounded(seconds), joints };
  return { path, verdict, stars, tags, notes, ...counts, ...worstIn(flags), flags: flags.map(flagText) };
}

function worstIn(flags: readonly Flag[]): Pick<ListedTake, 'worst' | 'unit' | 'kind'> {
  const flag = worstOf(flags);
  if (!flag) return {};
  const { value, unit } = statedAmount(flag);
  return { worst: rounded(value), unit, kind: flag.kind };
}

/** Frame times are printed with few digits: 0.008333 is 120 frames per second. */
function rounded(value: number): number {
  return Number(value.toFixed(3));
}
