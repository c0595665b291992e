/** What edits frames, or a take as a whole, would change one of its layers and not the others. */
import type { Take } from '../../model/takes/take.ts';
import { CommandError } from '../command-error.ts';

/** Refuses a take with layers, or that is attached in spans of its time, and says what to do first. */
export function refuseLayers({ name, layers, attached }: Take): void {
  if (attached)
    throw new CommandError(
      `${name} follows another character in spans of its time, and this changes takes as a whole. Detach it first: Edit > Detach.`,
    );
  if (!layers) return;
  throw new CommandError(
    `${name} has layers, and this changes takes as a whole. Flatten them first: Keys > Layers > Flatten layers, or run "layers.flatten". To keep the layers, do it on a duplicate of the take.`,
  );
}
