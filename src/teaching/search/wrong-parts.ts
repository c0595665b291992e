/**
 * Parts of the compared numbers that a mistake may explain, the larger ones first; what a larger one explains isn't cut
 * further.
 *
 *     all → each dump → each group of all dumps → each group of each dump
 *
 * With wrong numbers go the right ones of the same dumps: a mistake that would spoil them is no cause.
 */
import { CELL_GROUPS, type Cell, type CellGroup } from './cells.ts';
import type { CellOutcome } from './tried-programs.ts';

/** Cells that a mistake may explain together, with the right ones beside them. */
export interface Part {
  /** Indices of cells. */
  readonly cells: readonly number[];
  readonly wrong: readonly number[];
  /** The items that a cause's numbers count: joints, if there are any. */
  readonly counted: CellGroup;
  readonly isAll: boolean;
  /** Frames of those items: indices of the frames that they are of, ascending; empty for channels. */
  readonly frames: readonly number[];
  /** Whether it has all that its dumps have: as good as compared alone. */
  readonly isEntire: boolean;
}

/** The effect of a program on a part. */
export interface PartOutcome {
  /** Whether all numbers are theirs, within the tolerance, and some weren't; and all those that are changed. */
  readonly isWhole: boolean;
  readonly isPartial: boolean;
  /** How many numbers the program changes. */
  readonly evidence: number;
  /** The largest error of what is explained. */
  readonly residual: number;
  readonly agree: number;
  readonly of: number;
  /** Frames of the part. */
  readonly frames: readonly number[];
}

/** The parts of the numbers in which mistakes are looked for, the largest first, each once. */
export function partsOf(cells: readonly Cell[]): readonly Part[] {
  const all = cells.map((_, c) => c);
  const wrong = all.filter((c) => cells[c].isWrong);
  const parts: Part[] = [];
  const known = new Set<string>();
  const add = (of: readonly number[], isAll = false) => {
    const dumps = new Set(of.map((c) => cells[c].dump));
    const own = all.filter((c) => isAll || of.includes(c) || (dumps.has(cells[c].dump) && !cells[c].isWrong));
    if (known.has(own.join())) return;
    known.add(own.join());
    const counts = (isAll ? own : of).map((c) => cells[c].group);
    const counted = CELL_GROUPS.find((group) => counts.includes(group)) ?? 'joints';
    const isCounted = (c: number) => cells[c].group === counted && (isAll || of.includes(c));
    const frames = new Set(own.filter(isCounted).flatMap((c) => cells[c].pieces.map(({ frame }) => frame)));
    const isEntire = all.every((c) => own.includes(c) || !dumps.has(cells[c].dump));
    const ascending = [...frames].sort((a, b) => a - b);
    parts.push({ cells: own, wrong: of, counted, frames: ascending, isAll, isEntire });
  };
  add(wrong, true);
  for (const dump of new Set(wrong.map((c) => cells[c].dump))) add(wrong.filter((c) => cells[c].dump === dump));
  for (const group of CELL_GROUPS) {
    const of = wrong.filter((c) => cells[c].group === group);
    if (of.length > 0) add(of);
  }
  for (const c of wrong) add([c]);
  return parts;
}

/**
 * The effect of a program on a part.
 * @param outcomes of all cells, by index
 */
export function outcomeOf(part: Part, cells: readonly Cell[], outcomes: readonly CellOutcome[]): PartOutcome {
  let touches = false;
  let agrees = true;
  let isPartial = true;
  let [evidence, residual, agree, of] = [0, 0, 0, 0];
  for (const c of part.cells) {
    const outcome = outcomes[c];
    touches ||= outcome.touches;
    agrees &&= outcome.agrees;
    isPartial &&= outcome.isPartial;
    evidence += outcome.evidence;
    residual = Math.max(residual, outcome.residual);
    if (cells[c].group !== part.counted || !(part.isAll || part.wrong.includes(c))) continue;
    agree += outcome.agree;
    of += outcome.of;
  }
  return {
    isWhole: agrees && touches,
    isPartial: isPartial && touches,
    evidence,
    residual,
    agree,
    of,
    frames: part.frames,
  };
}
