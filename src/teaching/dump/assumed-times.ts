/**
 * The times of dumps that state none: programs begin with the file pose and say nothing of a time, whatever is asked
 * for or stated by others. The numbers decide: a dump is of the time at which it agrees, else of that at which the
 * fewest mistakes explain it. A right file pose would be `pose-ignored` at any other time.
 */
import type { Steps } from '../../evaluate/steps.ts';
import type { Character } from '../../model/document.ts';
import { isUntimed } from '../../model/dump.ts';
import { type Comparison, compare, isExplained } from '../compare/compare.ts';
import type { FrameTime } from '../program/evaluator.ts';
import { fitDumps, type NamedDump } from './fit-dump.ts';

/** Whether nothing states when it is; channels have times of their own. */
export function statesNoTime({ dump }: NamedDump): boolean {
  return dump.time === undefined && dump.blocks.length > 0 && dump.blocks.every(isUntimed);
}

/** How many mistakes explain it, 0 if all agrees; 3 if none are known. */
function mistakesIn(comparison: Comparison): number {
  if (comparison.agrees) return 0;
  return isExplained(comparison) ? comparison.causes[0].code.split('+').length : 3;
}

/** The dump with the time that explains it best; the first one that it fits at all, if they are equal. */
export function* assumeTime(
  character: Character,
  named: NamedDump,
  times: readonly FrameTime[],
  tolerance: number,
): Steps<NamedDump> {
  if (!statesNoTime(named)) return named;
  let best: NamedDump | undefined;
  let fewest = Number.POSITIVE_INFINITY;
  for (const time of new Set(times)) {
    const tried = { ...named, assumed: { time } };
    const { targets } = fitDumps(character, [tried], undefined);
    if (!targets) continue;
    // Channels alone.
    if (targets.frames.length === 0) return named;
    const mistakes = mistakesIn(yield* compare(character, targets, tolerance));
    if (mistakes >= fewest) continue;
    [best, fewest] = [tried, mistakes];
    if (mistakes === 0) break;
  }
  return best ?? named;
}
