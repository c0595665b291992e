/** Takes as other programs and formats have them: channels and samples alone. */
import type { Character } from '../../model/document.ts';
import { hasControls } from '../../model/takes/take.ts';
import { flattened } from '../layers/flatten.ts';
import type { FlattenOptions } from '../layers/flatten-options.ts';
import { solvedTake } from './flatten-goals.ts';

/**
 * The character with takes without layers, goals and attachments, which move it the same; the same object if none has
 * any.
 */
export function withPlainTakes(character: Character, options: FlattenOptions = {}): Character {
  const { takes, skeleton } = character;
  if (!takes.some(hasControls)) return character;
  const plain = takes.map((take) => solvedTake(character, flattened(take, skeleton, options).take, options));
  return { ...character, takes: plain };
}
