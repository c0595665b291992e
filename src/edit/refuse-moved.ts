/** During retargeting a character's own take is not visible, so it must not change. */
import type { Character } from '../model/document.ts';
import { CommandError } from './command-error.ts';

/** Refuses to change a take that is hidden by retargeting. */
export function refuseMoved({ name, driver }: Character): void {
  if (!driver) return;
  throw new CommandError(
    `${name} is retargeted from ${driver.source.take.name}, so its own keys don’t show. Bake the retargeting to edit it, or stop retargeting to use its own take.`,
  );
}
