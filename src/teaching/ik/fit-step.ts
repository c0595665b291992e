/** The number of a kind of step that comes nearest to what a program printed. */
import type { StepKind } from './steps.ts';

/** The step of one kind that comes nearest: its size, the change of each variable, and what remains. */
export interface FittedStep {
  readonly relative: number;
  readonly step: readonly number[];
  readonly error: number;
}

/** Powers of ten. */
const LEAST = -5;
const EACH = 0.1;
const GOLDEN = (Math.sqrt(5) - 1) / 2;
/** Each shortens the interval by the golden ratio: seven digits. */
const NARROWINGS = 32;
/** The number that fits is within an eighth of one of those tried first, which then is as much nearer. */
const HOPELESS = 0.25;

/**
 * Over eight orders of magnitude, then by golden section: an error of nearly linear numbers has one lowest place.
 * @param errorOf how far numbers are from what was printed after a step
 */
export function fitStep({ step, most }: StepKind, errorOf: (step: readonly number[]) => number): FittedStep {
  const at = (power: number) => errorOf(step(10 ** power));
  const last = Math.log10(most);
  const unmoved = at(LEAST);
  let [best, least] = [LEAST, unmoved];
  for (let power = LEAST + EACH; power < last + EACH / 2; power += EACH) {
    const error = at(power);
    if (error < least) [best, least] = [power, error];
  }
  if (!(least < HOPELESS * unmoved)) return { relative: 10 ** best, step: step(10 ** best), error: least };
  let [from, to] = [best - EACH, Math.min(last, best + EACH)];
  for (let i = 0; i < NARROWINGS; i++) {
    const [a, b] = [to - GOLDEN * (to - from), from + GOLDEN * (to - from)];
    if (at(a) < at(b)) to = b;
    else from = a;
  }
  const middle = (from + to) / 2;
  const relative = 10 ** (at(middle) < least ? middle : best);
  return { relative, step: step(relative), error: errorOf(step(relative)) };
}
