/** While another character's take moves one, its own take is not seen: nothing may change there unnoticed. */
import type { Character } from '../model/document.ts';
import { CommandError } from './store.ts';

/** Refuses what would change a take that nobody sees, because another one moves the character. */
export function refuseMoved({ name, driver }: Character): void {
  if (!driver) return;
  throw new CommandError(
    `${name} is moved by ${driver.source.clip.name}, and keys of its own would not be seen. Bake makes that a take of its own, which can be edited; Let go goes back to its own take.`,
  );
}
