/**
 * Finds which mistakes explain another program's numbers: each of the catalogue, then pairs of those that change
 * anything here. A program is tried with a few vertices and samples first; only those that survive are tried with all
 * numbers, and only those that explain them are causes.
 */
import { normalsOf } from '../evaluate/normals.ts';
import type { Steps } from '../evaluate/steps.ts';
import type { Character } from '../model/document.ts';
import { shownSkin } from '../model/document.ts';
import { DUMP_KINDS, type DumpKind } from '../model/dump.ts';
import type { Morph, MorphRows } from '../model/morph.ts';
import { oneSurface, type Skin } from '../model/skin.ts';
import { CATALOGUE } from './catalogue/all.ts';
import type { Mistake, Variant } from './catalogue/mistake.ts';
import { type Cell, type CellPiece, type ComparedNumbers, cellsOf } from './cells.ts';
import { pointError } from './errors.ts';
import { ownValues } from './own-values.ts';
import { outcomeOf, type Part, type PartOutcome, partsOf } from './parts.ts';
import { type Program, RIGHT_PROGRAM } from './program.ts';
import type { ChannelTarget, FrameTarget, Targets } from './targets.ts';
import { type CellOutcome, Trial } from './trial.ts';

/** What a cause of a part is about. */
export interface CauseSubject {
  readonly kinds: readonly DumpKind[];
  /** Of the dumps. */
  readonly files: readonly string[];
}

/** A mistake, or two, that make our numbers theirs. */
export interface Cause {
  /** `rotation-order`; of two mistakes `rotation-order+no-parent`. */
  readonly code: string;
  /** What exactly; of two mistakes both, with a semicolon. */
  readonly detail: string;
  /** Other ways to make the mistake that explain the same numbers as well. */
  readonly alternatives: readonly string[];
  /** Sentences for people: what was done and what should be. */
  readonly sentences: readonly string[];
  readonly formulas: readonly string[];
  /** Joints that are explained, of all; of vertices or channels if there are no joints. */
  readonly explains: number;
  readonly of: number;
  /** The largest remaining error. */
  readonly residual: number;
  /** Absent: all numbers that it touches. Else it explains these alone, and is counted in them. */
  readonly about?: CauseSubject;
}

interface Candidate {
  readonly mistake: Mistake;
  readonly variant: Variant;
  readonly program: Program;
  /** The rules that it changes: `joints order`. */
  readonly rules: ReadonlySet<string>;
}

/** Vertices that a small trial has, and samples per channel. */
const FEW_VERTICES = 24;
const FEW_SAMPLES = 6;
/**
 * Numbers that a part or a pair must change: of the thousands of pairs some would come near to a single point by chance.
 */
const MIN_EVIDENCE = 6;
/** Residuals that differ by less, of the tolerance, are equal: as digits that were not printed. */
const EQUAL_RESIDUALS = 0.01;
/** Programs tried between two reports of progress. */
const BETWEEN_STEPS = 16;

/** What explains the numbers. */
export interface FoundCauses {
  /** Causes of all numbers; else those of parts, each with what it is about, and last those of what they touch. */
  readonly causes: readonly Cause[];
  /** Where some parts are explained: those that aren't. */
  readonly unexplained?: CauseSubject;
}

/** What was found for a part. */
interface PartCauses {
  readonly part: Part;
  /** By code: mistakes that explain all of it; two of them; those that explain what they touch. */
  readonly singles: Map<string, Cause>;
  readonly pairs: Map<string, Cause>;
  readonly partial: Map<string, Cause>;
}

export function* findCauses(numbers: ComparedNumbers): Steps<FoundCauses> {
  const { character, targets, own, sizes, tolerance } = numbers;
  const { frames } = targets;
  const cells = cellsOf(numbers);
  const all = new Trial(character, frames, cells, sizes, tolerance);
  const few = fewOf(character, frames, cells, worstVertices(frames, own));
  const small = new Trial(few.character, few.frames, few.cells, sizes, tolerance);
  const finder = new Finder(cells, tolerance);
  const candidates = CATALOGUE.flatMap((mistake) => mistake.variants.map((variant) => candidateOf(mistake, variant)));

  const active: Candidate[] = [];
  const known = new Set<string>();
  const activate = (candidate: Candidate) => {
    // Several ways to make a mistake are often the same here.
    const key = `${candidate.mistake.code} ${small.fingerprint(candidate.program)}`;
    if (!known.has(key)) active.push(candidate);
    known.add(key);
  };
  for (let i = 0; i < candidates.length; i++) {
    const candidate = candidates[i];
    const glance = small.run(candidate.program, true);
    const touches = glance.some((outcome) => outcome.touches);
    // Limits may be reached only with another mistake.
    if (touches || candidate.mistake.code === 'limits-not-applied') activate(candidate);
    if (finder.mayBeExplained(glance)) {
      const outcomes = all.run(candidate.program, true);
      if (!touches && outcomes.some((outcome) => outcome.touches)) activate(candidate);
      finder.addSingle(candidate, outcomes);
    }
    yield (0.2 * i) / candidates.length;
  }
  if (!finder.isWhole) yield* findPairs(active, small, all, finder);
  return finder.found(targets);
}

function* findPairs(active: readonly Candidate[], small: Trial, all: Trial, finder: Finder): Steps<void> {
  let tried = 0;
  const count = (active.length * (active.length - 1)) / 2;
  finder.endSingles();
  for (let i = 0; i < active.length; i++) {
    for (let k = i + 1; k < active.length; k++) {
      const [a, b] = [active[i], active[k]];
      if (++tried % BETWEEN_STEPS === 0) yield 0.2 + (0.8 * tried) / count;
      if (a.mistake === b.mistake) continue;
      for (const program of bothOf(a, b)) {
        if (finder.isExplained(small.run(program, false))) finder.addPair([a, b], all.run(program, false));
      }
    }
  }
}

/** What is found, by part. */
class Finder {
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

  endSingles(): void {
    const explained = new Set(this.parts.flatMap(({ part, singles }) => (singles.size > 0 ? part.wrong : [])));
    this.open = this.smallest.filter(({ cell }) => !explained.has(cell));
  }

  addSingle(candidate: Candidate, outcomes: readonly CellOutcome[]): void {
    for (const { part, singles, partial } of this.parts) {
      const outcome = outcomeOf(part, this.cells, outcomes);
      if (outcome.isWhole && (part.isEntire || outcome.evidence >= MIN_EVIDENCE))
        this.keep(singles, [candidate], outcome);
      else if (outcome.isPartial && outcome.evidence >= MIN_EVIDENCE) this.keep(partial, [candidate], outcome);
    }
  }

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

  /** Of several ways to make the same mistakes the nearest; of those as near the first, and the others with it. */
  private keep(found: Map<string, Cause>, by: readonly Candidate[], outcome: PartOutcome): void {
    const { tolerance } = this;
    const { residual, agree, of } = outcome;
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
      residual,
    });
  }
}

/** What explains several parts is told once. */
function addCause(causes: Cause[], cause: Cause): void {
  const at = causes.findIndex(({ code, detail }) => code === cause.code && detail === cause.detail);
  if (at < 0) causes.push(cause);
  else causes[at] = joined(causes[at], cause);
}

function joined(a: Cause, b: Cause): Cause {
  const both = (key: keyof CauseSubject) => [...new Set([...(a.about?.[key] ?? []), ...(b.about?.[key] ?? [])])];
  return {
    ...a,
    explains: a.explains + b.explains,
    of: a.of + b.of,
    residual: Math.max(a.residual, b.residual),
    alternatives: a.alternatives.filter((each) => b.alternatives.includes(each)),
    about: { kinds: DUMP_KINDS.filter((kind) => both('kinds').includes(kind)), files: both('files') },
  };
}

function subjectOf({ origins }: Targets, cells: readonly Cell[]): CauseSubject {
  const files = cells.flatMap(({ dump }) => origins?.fileNames[dump] ?? []);
  return { kinds: [...new Set(cells.flatMap(({ kinds }) => kinds))], files: [...new Set(files)] };
}

/** A program with both mistakes; two where their order matters, none where one replaces the other. */
function bothOf(a: Candidate, b: Candidate): readonly Program[] {
  const shared = [...a.rules].filter((rule) => b.rules.has(rule));
  // Curves are kept by identity, so the program of the one that changes them is the first.
  const [first, second] = b.program.curves !== RIGHT_PROGRAM.curves ? [b, a] : [a, b];
  const program = second.variant.apply(first.program);
  if (shared.length === 0) return [program];
  return shared.every((rule) => rule === 'joints world') ? [program, first.variant.apply(second.program)] : [];
}

function candidateOf(mistake: Mistake, variant: Variant): Candidate {
  const program = variant.apply(RIGHT_PROGRAM);
  const rules = new Set<string>();
  for (const group of ['joints', 'skin', 'curves'] as const) {
    const [now, right] = [program[group], RIGHT_PROGRAM[group]];
    if (now === right) continue;
    const before = new Map(Object.entries(right));
    for (const [rule, value] of Object.entries(now)) if (before.get(rule) !== value) rules.add(`${group} ${rule}`);
  }
  return { mistake, variant, program, rules };
}

function sorted(found: ReadonlyMap<string, Cause>): readonly Cause[] {
  return [...found.values()].sort((a, b) => a.residual - b.residual);
}

// ——— a few of everything ———

function fewOf(character: Character, frames: readonly FrameTarget[], cells: readonly Cell[], worst: readonly number[]) {
  const skin = shownSkin(character);
  const few = skin ? chosen(skin, worst) : [];
  const pick = (values: Float64Array | undefined) => values && rowsOf(values, few);
  return {
    character: skin
      ? { ...character, skins: [skinOf(skin, few)], shownSkin: 0, morphs: character.morphs.map((m) => morphOf(m, few)) }
      : character,
    frames,
    cells: cells.map((cell): Cell => {
      const pieces = cell.pieces.map(({ frame, target }): CellPiece => {
        const [vertices, normals] = [pick(target.vertices), pick(target.normals)];
        return { frame, target: { ...target, ...(vertices && { vertices }), ...(normals && { normals }) } };
      });
      return { ...cell, pieces, channels: fewSamples(character, cell.channels) };
    }),
  };
}

/** The worst, some evenly spread, and those that mistakes in attachments show at. */
function chosen({ positions, attachments }: Skin, worst: readonly number[]): number[] {
  const count = positions.length / 3;
  const all = new Set(worst.slice(0, FEW_VERTICES / 2));
  const most = (of: (joint: number, weights: Float64Array) => number) => {
    if (!attachments) return;
    const { start, joints, weights } = attachments;
    let best = 0;
    let value = Number.NEGATIVE_INFINITY;
    for (let v = 0; v < count; v++) {
      if (start[v] === start[v + 1]) continue;
      const own = of(joints[start[v]], weights.subarray(start[v], start[v + 1]));
      if (own > value) [best, value] = [v, own];
    }
    all.add(best);
  };
  most((joint) => joint);
  most((joint) => -joint);
  most((_, weights) => weights.length);
  most((_, weights) => Math.abs(weights.reduce((sum, w) => sum + w, -1)));
  for (let i = 0; i < FEW_VERTICES / 2 && i < count; i++) all.add(Math.floor((i * count) / (FEW_VERTICES / 2)));
  return [...all].sort((a, b) => a - b);
}

function rowsOf(values: Float64Array, rows: readonly number[]): Float64Array {
  return Float64Array.from({ length: 3 * rows.length }, (_, i) => values[3 * rows[Math.floor(i / 3)] + (i % 3)]);
}

function skinOf(skin: Skin, few: readonly number[]): Skin {
  const { positions, normals, attachments, bindings } = skin;
  const start = [0];
  const joints: number[] = [];
  const weights: number[] = [];
  for (const v of few) {
    for (let a = attachments?.start[v] ?? 0; a < (attachments?.start[v + 1] ?? 0); a++) {
      joints.push(attachments?.joints[a] ?? 0);
      weights.push(attachments?.weights[a] ?? 0);
    }
    start.push(joints.length);
  }
  return {
    name: skin.name,
    positions: rowsOf(positions, few),
    normals: rowsOf(normals ?? normalsOf(skin), few),
    triangles: new Uint32Array(0),
    surfaces: oneSurface(new Uint32Array(0)),
    bindings,
    ...(attachments && {
      attachments: {
        start: Uint32Array.from(start),
        joints: Uint32Array.from(joints),
        weights: Float64Array.from(weights),
      },
    }),
  };
}

function morphOf(morph: Morph, few: readonly number[]): Morph {
  const rows = ({ indices, values }: MorphRows): MorphRows => {
    const at = new Map(few.map((v, i) => [v, i]));
    const own: number[] = [];
    const kept: number[] = [];
    indices.forEach((v, row) => {
      const index = at.get(v);
      if (index === undefined) return;
      own.push(index);
      kept.push(...values.subarray(3 * row, 3 * row + 3));
    });
    return { indices: Uint32Array.from(own), values: Float64Array.from(kept) };
  };
  return { name: morph.name, positions: rows(morph.positions), normals: rows(morph.normals) };
}

/** Of each channel those that differ most, and the first ones. */
function fewSamples(character: Character, target: ChannelTarget): ChannelTarget {
  const { channels, times, values } = target;
  const own = ownValues(character, target);
  const kept: number[] = [];
  for (let from = 0; from < channels.length; ) {
    let to = from;
    while (to < channels.length && channels[to] === channels[from]) to++;
    const rows = Array.from({ length: to - from }, (_, i) => from + i);
    rows.sort((a, b) => Math.abs(own[b] - values[b]) - Math.abs(own[a] - values[a]));
    kept.push(...rows.slice(0, FEW_SAMPLES).sort((a, b) => a - b));
    from = to;
  }
  return {
    channels: Uint32Array.from(kept, (i) => channels[i]),
    times: Float64Array.from(kept, (i) => times[i]),
    values: Float64Array.from(kept, (i) => values[i]),
  };
}

/** The vertices with the largest errors at any of the times, the worst first. */
function worstVertices(
  frames: readonly FrameTarget[],
  own: readonly { readonly vertices: Float64Array; readonly normals: Float64Array }[],
): number[] {
  const counts = frames.map(({ vertices, normals }) => ((vertices ?? normals)?.length ?? 0) / 3);
  const errors = new Float64Array(Math.max(0, ...counts));
  frames.forEach(({ vertices, normals }, f) => {
    for (const [theirs, ours] of [
      [vertices, own[f].vertices],
      [normals, own[f].normals],
    ] as const) {
      for (let o = 0; theirs && o < theirs.length; o += 3) {
        errors[o / 3] = Math.max(errors[o / 3], pointError(theirs, o, ours, o, 1));
      }
    }
  });
  const worst: number[] = [];
  for (let v = 0; v < errors.length; v++) {
    if (worst.length === FEW_VERTICES && errors[v] <= errors[worst[worst.length - 1]]) continue;
    const at = worst.findIndex((w) => errors[v] > errors[w]);
    worst.splice(at < 0 ? worst.length : at, 0, v);
    worst.length = Math.min(worst.length, FEW_VERTICES);
  }
  return worst;
}
