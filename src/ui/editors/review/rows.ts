/** The list of takes in review: what each row says, which are listed, and in which order. */
import { perObject } from '../../../model/per-object.ts';
import type { ReviewedTake } from '../../../model/takes/review.ts';
import type { TakeDigest } from '../../../review/digest.ts';
import { badness, FLAG_KINDS, type Flag, type FlagKind, worstOf } from '../../../review/flags.ts';
import { type ReviewColumn, type ReviewView, reviewName } from '../../state/review.ts';

export interface ReviewRow {
  readonly take: ReviewedTake;
  readonly name: string;
  /** Undefined until its file was read. */
  readonly digest: TakeDigest | undefined;
  /** Its file was given in this visit. */
  readonly hasFile: boolean;
}

const nameOf = perObject(({ path }: ReviewedTake): string => reviewName(path));

/** Rows of all takes, in the order of the list. */
export function reviewRows(
  takes: readonly ReviewedTake[],
  files: { has(path: string): boolean; digest(path: string): TakeDigest | undefined } | undefined,
): readonly ReviewRow[] {
  return takes.map((take) => ({
    take,
    name: nameOf(take),
    digest: files?.digest(take.path),
    hasFile: files?.has(take.path) ?? false,
  }));
}

/** Those that the filters leave, sorted; equal ones in the order of the list. */
export function listedRows(rows: readonly ReviewRow[], view: ReviewView): readonly ReviewRow[] {
  const listed = rows.filter((row) => isListed(row, view));
  const { order } = view;
  if (!order) return listed;
  const sign = order.descending ? -1 : 1;
  const keyed = listed.map((row, place) => ({ row, place, key: keyOf(row, order.column, view) }));
  keyed.sort((a, b) => {
    // What isn't known yet comes last, either way.
    if (a.key === undefined || b.key === undefined) {
      return Number(a.key === undefined) - Number(b.key === undefined) || a.place - b.place;
    }
    return sign * compared(a.key, b.key) || a.place - b.place;
  });
  return keyed.map(({ row }) => row);
}

/** The kind of flag that is listed, if it is one. */
export function kindListed({ flag }: ReviewView): FlagKind | undefined {
  return FLAG_KINDS.find((kind) => kind === flag);
}

/** The worst flag of a take, of those that are listed. */
export function worstListed({ digest }: ReviewRow, view: ReviewView): Flag | undefined {
  return worstOf(digest?.found?.facts.flags ?? [], kindListed(view));
}

/** Whether both list the same takes, sorted or not. */
export function isSameFilter(a: ReviewView, b: ReviewView): boolean {
  const { text, verdict, flag, bad, tag, stars } = a;
  return (
    text === b.text && verdict === b.verdict && flag === b.flag && bad === b.bad && tag === b.tag && stars === b.stars
  );
}

/** Whether anything but the order differs from all takes. */
export function isFiltered({ text, verdict, flag, tag, stars }: ReviewView): boolean {
  return text !== '' || verdict !== undefined || flag !== undefined || tag !== undefined || stars > 0;
}

function isListed({ take, digest }: ReviewRow, { text, verdict, flag, bad = 0, tag, stars }: ReviewView): boolean {
  if (verdict !== undefined && take.verdict !== verdict) return false;
  if (take.stars < stars) return false;
  if (tag !== undefined && !take.tags.includes(tag)) return false;
  if (flag !== undefined) {
    const flags = digest?.found?.facts.flags;
    if (!flags) return false;
    const isAny = flag === 'any' || flag === 'none';
    const has = isAny ? flags.length > 0 : flags.some((each) => each.kind === flag && badness(each) >= bad);
    if (has === (flag === 'none')) return false;
  }
  const wanted = text.trim().toLowerCase();
  if (wanted === '') return true;
  return [take.path, take.notes, ...take.tags].some((each) => each.toLowerCase().includes(wanted));
}

type Key = string | number;

function keyOf(row: ReviewRow, column: ReviewColumn, view: ReviewView): Key | undefined {
  const { take, name, digest } = row;
  const facts = digest?.found?.facts;
  switch (column) {
    case 'name':
      return name;
    case 'verdict':
      return take.verdict === 'good' ? 0 : take.verdict === 'bad' ? 2 : 1;
    case 'stars':
      return take.stars;
    case 'tags':
      return take.tags.join(', ') || undefined;
    case 'notes':
      return take.notes || undefined;
    case 'flags':
      return facts?.flags.length;
    case 'worst': {
      const worst = worstListed(row, view);
      return worst ? badness(worst) : facts && 0;
    }
    default:
      return facts?.[column];
  }
}

const byName = new Intl.Collator('en', { numeric: true });

function compared(a: Key, b: Key): number {
  return typeof a === 'number' && typeof b === 'number' ? a - b : byName.compare(String(a), String(b));
}

/** All tags of the list, in alphabetical order. */
export function tagsIn(takes: readonly ReviewedTake[]): readonly string[] {
  return [...new Set(takes.flatMap(({ tags }) => tags))].sort(byName.compare);
}
