/**
 * Which of several characters dumps are of: by the names of joints in them, then by what they are. Rows of matrices may
 * be as wide as rows of a time and three channels, but rows with the names of joints are no channels.
 */
import type { Character } from '../../model/document.ts';
import { stemOf } from '../../model/files.ts';
import { worstError } from '../compare/compare.ts';
import type { Targets } from '../compare/targets.ts';
import type { Fitted, NamedDump } from './fit-dump.ts';
import { fitDumpsAt } from './times.ts';

/** The character that dumps fit best, and how they do. */
export interface BestFit {
  readonly character: Character;
  readonly fitted: Fitted;
}

/** Undefined if the dumps fit none. @param times of dumps that state none; as for `fitDumpsAt` */
export function bestFit(
  characters: readonly Character[],
  dumps: readonly NamedDump[],
  times: readonly number[],
): BestFit | undefined {
  const fits = characters.flatMap((character) => {
    const fitted = fitDumpsAt(character, dumps, times);
    return fitted.targets ? [{ character, fitted, targets: fitted.targets }] : [];
  });
  const ranked = fits.map((fit) => ({
    ...fit,
    // Smaller is better, the first that differs decides.
    rank: fits.length < 2 ? [] : ranksOf(fit.character, fit.targets, dumps),
  }));
  ranked.sort((a, b) => {
    const at = a.rank.findIndex((value, i) => value !== b.rank[i]);
    return at < 0 ? 0 : a.rank[at] - b.rank[at];
  });
  return ranked[0];
}

function ranksOf(character: Character, targets: Targets, dumps: readonly NamedDump[]): readonly number[] {
  return [
    -namedJoints(character, dumps),
    -sharedName(character, dumps),
    // A labelled row is a joint's or a vertex's, so it is no row of times and values.
    targets.frames.length === 0 && dumps.some(isLabelled) ? 1 : 0,
    worstError(character, targets),
  ];
}

function isLabelled({ dump }: NamedDump): boolean {
  return dump.blocks.some(({ labels }) => labels?.some((label) => label !== null));
}

/** How many labels are names of its joints. */
function namedJoints({ skeleton }: Character, dumps: readonly NamedDump[]): number {
  const names = new Set(skeleton?.joints.flatMap(({ name }) => (name ? [name.toLowerCase()] : [])));
  const labels = dumps.flatMap(({ dump }) => dump.blocks.flatMap((block) => block.labels ?? []));
  return labels.filter((label) => label?.name !== undefined && names.has(label.name.trim().toLowerCase())).length;
}

/** How many letters of the longest name of its files the dumps begin with. */
function sharedName({ sources }: Character, dumps: readonly NamedDump[]): number {
  const stems = sources.map((source) => stemOf(source).toLowerCase());
  const shared = dumps.flatMap(({ dump }) =>
    stems.map((stem) => (dump.name.toLowerCase().startsWith(stem) ? stem.length : 0)),
  );
  return Math.max(0, ...shared);
}
