/** What is said of a character that another one's take moves, wherever it is named. */
import type { Character, Document } from '../../../model/document.ts';

/** `follows rokoko-dance`; empty where its own take moves it. */
export function followsText({ driver }: Character): string {
  return driver ? `follows ${driver.source.clip.name || driver.source.name}` : '';
}

/** `moves walker`; empty where its take moves nobody else. */
export function movesText({ characters }: Document, { id }: Character): string {
  const names = characters.filter(({ driver }) => driver?.sourceId === id).map(({ name }) => name);
  return names.length ? `drives ${names.join(', ')}` : '';
}
