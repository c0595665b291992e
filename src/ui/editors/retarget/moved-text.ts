/** Short texts about characters that are retargeted, or follow a joint of another one. */
import type { Character, Document } from '../../../model/document.ts';

/** `follows rokoko-dance`, or the characters to which it is attached; empty if its own take alone moves it. */
export function followsText({ driver, leaders = [] }: Character): string {
  const names = driver ? [driver.source.take.name || driver.source.name] : leaders.map(({ name }) => name);
  return names.length ? `follows ${names.join(', ')}` : '';
}

/** `moves walker`; empty if its take moves no other character. */
export function movesText({ characters }: Document, { id }: Character): string {
  const names = characters.filter(({ driver }) => driver?.sourceId === id).map(({ name }) => name);
  return names.length ? `drives ${names.join(', ')}` : '';
}
