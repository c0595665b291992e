/** Short texts about retargeted characters. */
import type { Character, Document } from '../../../model/document.ts';

/** `follows rokoko-dance`; empty if its own take moves it. */
export function followsText({ driver }: Character): string {
  return driver ? `follows ${driver.source.take.name || driver.source.name}` : '';
}

/** `moves walker`; empty if its take moves no other character. */
export function movesText({ characters }: Document, { id }: Character): string {
  const names = characters.filter(({ driver }) => driver?.sourceId === id).map(({ name }) => name);
  return names.length ? `drives ${names.join(', ')}` : '';
}
