/** Shows ghosts by a script, with the arguments of `view.ghosts`. No undo step. */
import { CommandError } from '../../../edit/command-error.ts';
import { index, number, oneOf, optional, record } from '../../../edit/schema/shape.ts';
import { GHOST_SHAPES, MAX_GHOSTS } from '../../../model/session.ts';
import type { Uses } from '../../state/workbench.ts';

const ARGS = record({
  at: oneOf(['keys', 'frames']),
  /** For `frames`: how many frames lie between two ghosts, greater than 0; default 1. */
  every: optional(number),
  before: index,
  after: index,
  of: oneOf(GHOST_SHAPES),
});

/** @throws CommandError for arguments of another shape, or numbers out of range */
export function showGhosts(wb: Uses<'settings'>, given: unknown): void {
  const { at, every = 1, before, after, of } = ARGS.read(given, '');
  for (const [name, count] of Object.entries({ before, after })) {
    if (count > MAX_GHOSTS) throw new CommandError(`"${name}" must be at most ${MAX_GHOSTS}, found ${count}.`);
  }
  if (!(every > 0)) throw new CommandError(`"every" must be greater than 0, found ${every}.`);
  const step = at === 'frames' && { ghostStep: every };
  const ghosts = { ghosts: true, ghostsBefore: before, ghostsAfter: after, ghostStepIn: at, ...step, ghostsOf: of };
  wb.settings.update((now) => ({ ...now, display: { ...now.display, ...ghosts } }));
}
