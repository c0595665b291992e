/**
 * Causes that explain another program's numbers, by part: of the programs that were tried those that explain all of a
 * part, by one mistake before two, and those that explain what they touch of it.
 */
import { DUMP_KINDS, type DumpKind } from '../../model/dump.ts';
import type { Targets } from '../compare/targets.ts';
import type { Candidate } from './candidates.ts';
import { CELL_GROUPS, type Cell, groupOf } from './cells.ts';
import type { CellOutcome } from './tried-programs.ts';
import { outcomeOf, type Part, type PartOutcome, partsOf } from './wrong-parts.ts';

/** The subject of a part's cause. */
export interface CauseSubject {
  readonly kinds: readonly DumpKind[];
  /** Files of the dumps. */
  readonly files: readonly string[];
}

/** A mistake, or two, that make our numbers theirs. */
export interface Cause {
  /** `rotation-order`; of two mistakes `rotation-order+no-parent`. */
  readonly code: string;
  /** The exact deviation; of two mistakes both, with a semicolon. */
  readonly detail: string;
  /** Other ways to make the mistake that explain the same numbers as well. */
  readonly alternatives: readonly string[];
  /** Sentences for people: what was done and what should be. */
  readonly sentences: readonly string[];
  readonly formulas: readonly string[];
  /** Joints that are explained, of all; of vertices or channels if there are no joints. */
  readonly explains: number;
  readonly of: number;
  /** Frames of those counted items: indices of the frames that they are of, ascending; empty for channels. */
  readonly frames: readonly number[];
  /** The largest remaining error. */
  readonly residual: number;
  /** Absent: all numbers that it touches. Else it explains these alone, and is counted in them. */
  readonly about?: CauseSubject;
}

/**
 * Numbers that a part or a pair must change: of the thousands of pairs some would come near to a single point by
 * chance.
 */
const MIN_EVIDENCE = 6;
/** Residuals that differ by less, of the tolerance, are equal: as digits that were not printed. */
const EQUAL_RESIDUALS = 0.01;

/** Causes that explain the numbers. */
export interface FoundCauses {
  /** Causes of all numbers; else those of parts, each with what it is about, and last those of what they touch. */
  readonly causes: readonly Cause[];
  /** Where some parts are explained: those that aren't. */
  readonly unexplained?: CauseSubject;
}

/** Causes found for a part. */
interface PartCauses {
  readonly part: Part;
  /** By code: mistakes that explain all of it; two of them; those that explain what they touch. */
  readonly singles: Map<string, Cause>;
  readonly pairs: Map<string, Cause>;
  readonly partial: Map<string, Cause>;
}

/** Collects the causes that are found, by part. */
export class Finder {
  private readonly parts: readonly PartCauses[];
  /** Wrong cells, each with the right ones of its dump. */
  private readonly smallest: readonly { readonly cell: number; readonly right: readonly number[] }[];
  /** Those of them that no single mistake explains. */
  private open: Finder['smallest'];

  constructor(
    private readonly cells: readonly Cell[],
    private readonly tolerance: number,
  ) {
    this.parts = partsOf(cells).map((part) => ({ part, singles: new Map(), pairs: new Map(), partial: new Map() }));
    this.smallest = cells.flatMap(({ isWrong, dump }, cell) => {
      const right = cells.flatMap((each, c) => (each.dump === dump && !each.isWrong ? [c] : []));
      return isWrong ? [{ cell, right }] : [];
    });
    this.open = this.smallest;
  }

  /** Whether a single mistake explains all. */
  get isWhole(): boolean {
    return this.parts[0].singles.size > 0;
  }

  /** Whether a single mistake may explain a part, by a few of its numbers. */
  mayBeExplained(few: readonly CellOutcome[]): boolean {
    return this.smallest.some(({ cell, right }) => {
      if (!few[cell].isPartial || !right.every((c) => few[c].isPartial)) return false;
      // All joints are tried; of others something that isn't among the few may be changed.
      return few[cell].touches || this.cells[cell].group !== 'joints';
    });
  }

  /** Whether a pair may explain a part that no single mistake explains, or all. */
  isExplained(few: readonly CellOutcome[]): boolean {
    const isBy = ({ cell, right }: Finder['smallest'][number]) =>
      few[cell].agrees && few[cell].touches && right.every((c) => few[c].agrees);
    return this.open.some(isBy) || this.smallest.every(isBy);
  }

  /** Ends the trials of single mistakes: pairs are only tried for what none of these explains. */
  endSingles(): void {
    const explained = new Set(this.parts.flatMap(({ part, singles }) => (singles.size > 0 ? part.wrong : [])));
    this.open = this.smallest.filter(({ cell }) => !explained.has(cell));
  }

  /**
   * Keeps a mistake for the parts that it explains, or of which it explains what it touches.
   * @param outcomes one per cell
   */
  addSingle(candidate: Candidate, outcomes: readonly CellOutcome[]): void {
    for (const { part, singles, partial } of this.parts) {
      const outcome = outcomeOf(part, this.cells, outcomes);
      if (outcome.isWhole && (part.isEntire || outcome.evidence >= MIN_EVIDENCE))
        this.keep(singles, [candidate], outcome);
      else if (outcome.isPartial && outcome.evidence >= MIN_EVIDENCE) this.keep(partial, [candidate], outcome);
    }
  }

  /**
   * Keeps a pair of mistakes for the parts that it explains.
   * @param outcomes one per cell
   */
  addPair(pair: readonly Candidate[], outcomes: readonly CellOutcome[]): void {
    for (const { part, pairs } of this.parts) {
      const outcome = outcomeOf(part, this.cells, outcomes);
      if (outcome.isWhole && outcome.evidence >= MIN_EVIDENCE) this.keep(pairs, pair, outcome);
    }
  }

  /** The largest parts that are explained, each by one mistake before two. */
  found(targets: Targets): FoundCauses {
    const open = new Set(this.smallest.map(({ cell }) => cell));
    const whole: Cause[] = [];
    const partial: Cause[] = [];
    for (const { part, singles, pairs, partial: touched } of this.parts) {
      const about = part.isAll
        ? {}
        : {
            about: subjectOf(
              targets,
              part.wrong.map((c) => this.cells[c]),
            ),
          };
      const told = (causes: ReadonlyMap<string, Cause>) => sorted(causes).map((cause) => ({ ...cause, ...about }));
      const explaining = singles.size > 0 ? singles : pairs;
      // Beside an explanation of everything, one of a part says nothing more.
      if (!part.wrong.every((c) => open.has(c))) continue;
      if (explaining.size === 0) partial.unshift(...told(touched));
      else {
        for (const cause of told(explaining)) addCause(whole, cause);
        for (const c of part.wrong) open.delete(c);
      }
    }
    if (open.size === 0) return { causes: whole };
    const codes = new Set(whole.map(({ code }) => code));
    const causes = [...whole, ...partial.filter(({ code }) => !codes.has(code) && codes.add(code))];
    const isPartly = causes.length > 0 && this.cells.length > 1;
    return {
      causes,
      ...(isPartly && {
        unexplained: subjectOf(
          targets,
          [...open].map((c) => this.cells[c]),
        ),
      }),
    };
  }

  /**
   * Keeps the nearest of several ways to make the same mistakes; of those as near the first, and the others with it.
   */
  private keep(found: Map<string, Cause>, by: readonly Candidate[], outcome: PartOutcome): void {
    const { tolerance } = this;
    const { residual, agree, of, frames } = outcome;
    const code = by.map(({ mistake }) => mistake.code).join('+');
    const known = found.get(code);
    const details = by.map(({ variant }) => variant.detail).filter((detail) => detail !== '');
    const difference = known ? residual - known.residual : Number.NEGATIVE_INFINITY;
    if (known && difference > -EQUAL_RESIDUALS * tolerance) {
      const isAnother = by.length === 1 && !by[0].variant.isFiner && difference < EQUAL_RESIDUALS * tolerance;
      if (isAnother) found.set(code, { ...known, alternatives: [...known.alternatives, ...details] });
      return;
    }
    found.set(code, {
      code,
      detail: details.join('; '),
      alternatives: [],
      sentences: by.map(({ mistake, variant }) => mistake.sentence(variant.detail)),
      formulas: by.map(({ mistake }) => mistake.formula),
      explains: agree,
      of,
      frames,
      residual,
    });
  }
}

/** Adds a cause; one that explains several parts is listed once. */
function addCause(causes: Cause[], cause: Cause): void {
  const at = causes.findIndex(({ code, detail }) => code === cause.code && detail === cause.detail);
  if (at < 0) causes.push(cause);
  else causes[at] = joined(causes[at], cause);
}

function joined(a: Cause, b: Cause): Cause {
  const both = (key: keyof CauseSubject) => [...new Set([...(a.about?.[key] ?? []), ...(b.about?.[key] ?? [])])];
  // Joints aren't counted with vertices: what is counted is what `compared-text.ts` calls it.
  const [first, second] = groupRank(b) < groupRank(a) ? [b, a] : [a, b];
  const isSame = groupRank(a) === groupRank(b);
  return {
    ...a,
    explains: first.explains + (isSame ? second.explains : 0),
    of: first.of + (isSame ? second.of : 0),
    frames: isSame ? [...new Set([...a.frames, ...b.frames])].sort((x, y) => x - y) : first.frames,
    residual: Math.max(a.residual, b.residual),
    alternatives: a.alternatives.filter((each) => b.alternatives.includes(each)),
    about: { kinds: DUMP_KINDS.filter((kind) => both('kinds').includes(kind)), files: both('files') },
  };
}

/** Rank of what is counted. */
function groupRank({ about }: Cause): number {
  return CELL_GROUPS.indexOf(groupOf(about?.kinds ?? []));
}

function subjectOf({ origins }: Targets, cells: readonly Cell[]): CauseSubject {
  const files = cells.flatMap(({ dump }) => origins?.fileNames[dump] ?? []);
  return { kinds: [...new Set(cells.flatMap(({ kinds }) => kinds))], files: [...new Set(files)] };
}

function sorted(found: ReadonlyMap<string, Cause>): readonly Cause[] {
  return [...found.values()].sort((a, b) => a.residual - b.residual);
}
