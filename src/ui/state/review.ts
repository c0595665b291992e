/** Takes in review, beside the document: their files, how the list is filtered and sorted, and the one that is shown. */

import { isReviewable, REVIEWED_EXTENSIONS } from '../../files/kinds.ts';
import type { Character } from '../../model/document.ts';
import { baseName } from '../../model/files.ts';
import { NO_REVIEW, type Review, type ReviewedTake, type Verdict } from '../../model/takes/review.ts';
import type { TakeDigest } from '../../review/digest.ts';
import type { FlagKind } from '../../review/flags.ts';
import { type Observable, observable } from '../widgets/observable.ts';
import type { SortOrder } from '../widgets/table/sort-heads.ts';

/** What is given for review, for users: `.bvh, .glb`. */
export const REVIEWED_LIST = REVIEWED_EXTENSIONS.map((extension) => `.${extension}`).join(', ');

/** The name of a take in review: that of its file, without an extension that all have. */
export function reviewName(path: string): string {
  return isReviewable(path) ? baseName(path).replace(/\.\w+$/, '') : baseName(path);
}

/** More takes than these given at once are reviewed; fewer are opened. */
export const MAX_OPENED = 20;

export const REVIEW_COLUMNS = [
  'name',
  'verdict',
  'stars',
  'seconds',
  'frames',
  'fps',
  'joints',
  'flags',
  'worst',
  'tags',
  'notes',
] as const;
export type ReviewColumn = (typeof REVIEW_COLUMNS)[number];

export interface ReviewView {
  /** Part of a path, a note or a tag. */
  readonly text: string;
  /** Only these; absent: all. */
  readonly verdict?: Verdict;
  /** With such a flag, with any, or checked and without. */
  readonly flag?: FlagKind | 'any' | 'none';
  /** Of one kind of flag: at least so bad (`badness`); absent: any. */
  readonly bad?: number;
  readonly tag?: string;
  /** At least so many. */
  readonly stars: number;
  /** Absent: as in the list. */
  readonly order?: SortOrder<ReviewColumn>;
  /** Paths of the selected takes, and of the one with the keyboard. */
  readonly chosen: ReadonlySet<string>;
  readonly focused?: string;
}

/** The files of takes in review: they are read when they are needed, and only then. */
export interface ReviewFiles {
  has(path: string): boolean;
  /** What is known of a take; undefined until its file was read. */
  digest(path: string): TakeDigest | undefined;
  /** Reads these first. */
  want(paths: readonly string[]): void;
  /** The take as a character, to be drawn; undefined if it can't be read. */
  character(path: string): Promise<Character | undefined>;
  /** Opens takes as characters. */
  open(paths: readonly string[]): void;
  /** Takes whose files were read, of those that have one; changes with every one. */
  readonly progress: Observable<ReviewProgress>;
}

export interface ReviewProgress {
  readonly done: number;
  readonly of: number;
}

const ALL: ReviewView = { text: '', stars: 0, chosen: new Set() };

export class ReviewState {
  readonly view: Observable<ReviewView> = observable(ALL);
  /** A take that is drawn in place of the document's characters. */
  readonly shown: Observable<Character | undefined> = observable<Character | undefined>(undefined);
  /** Absent until takes were given. */
  readonly files: Observable<ReviewFiles | undefined> = observable<ReviewFiles | undefined>(undefined);

  /** What the list that was saved or read last says of takes, by path. */
  readonly saved: Observable<ReadonlyMap<string, Review>> = observable<ReadonlyMap<string, Review>>(new Map());

  /** Takes that a list says the same about. */
  areSaved(takes: readonly ReviewedTake[]): void {
    this.saved.update((now) => new Map([...now, ...takes.map((take) => [take.path, take] as const)]));
  }

  /** Whether something is said about takes that no list has. */
  isUnsaved(takes: readonly ReviewedTake[]): boolean {
    const saved = this.saved.get();
    return takes.some((take) => !isSameReview(take, saved.get(take.path) ?? NO_REVIEW));
  }

  change(change: Partial<ReviewView>): void {
    this.view.update((now) => ({ ...now, ...change }));
  }
}

function isSameReview(a: Review, b: Review): boolean {
  return a.verdict === b.verdict && a.stars === b.stars && a.notes === b.notes && a.tags.join(';') === b.tags.join(';');
}
