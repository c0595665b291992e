/** What edits frames, or a take as a whole, would change one of its layers and not the others. */
import type { Take } from '../../model/takes/take.ts';
import { CommandError } from '../command-error.ts';

/** Refuses a take with layers, and says what to do first. */
export function refuseLayers({ name, layers }: Take): void {
  if (!layers) return;
  throw new CommandError(
    `${name} has layers, and this changes takes as a whole. Flatten them first: Keys > Layers > Flatten layers, or run "layers.flatten". To keep the layers, do it on a duplicate of the take.`,
  );
}
