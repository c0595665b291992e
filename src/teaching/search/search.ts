/**
 * Finds which mistakes explain another program's numbers: each of the catalogue, then pairs of those that change
 * anything here. A program is tried with a few vertices and samples first; only those that survive are tried with all
 * numbers, and only those that explain them are causes.
 */
import type { Steps } from '../../evaluate/steps.ts';
import { CATALOGUE } from '../catalogue/all.ts';
import { bothOf, type Candidate, candidateOf } from './candidates.ts';
import { type ComparedNumbers, cellsOf } from './cells.ts';
import { fewOf } from './few-numbers.ts';
import { Finder, type FoundCauses } from './found-causes.ts';
import { Trial } from './tried-programs.ts';

/** Programs tried between two reports of progress. */
const BETWEEN_STEPS = 16;

/** Yields how much is done, from 0 to 1. */
export function* findCauses(numbers: ComparedNumbers): Steps<FoundCauses> {
  const { character, targets, own, sizes, tolerance } = numbers;
  const { frames } = targets;
  const cells = cellsOf(numbers);
  const all = new Trial(character, frames, cells, sizes, tolerance);
  const few = fewOf(character, frames, cells, own, tolerance);
  const small = new Trial(few.character, frames, few.cells, sizes, tolerance);
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
