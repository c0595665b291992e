/** While another character's take moves one, its own take is not seen: nothing may change there unnoticed. */
import type { Character } from '../model/document.ts';
import { CommandError } from './store.ts';

/** Refuses what would change a take that nobody sees, because another one moves the character. */
export function refuseMoved({ name, driver }: Character): void {
  if (!driver) return;
  throw new CommandError(
    `${name} is retargeted from ${driver.source.clip.name}, so its own keys don’t show. Bake the retargeting to edit it, or stop retargeting to use its own take.`,
  );
}
