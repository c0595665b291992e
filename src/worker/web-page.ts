/** Writes a page that shows characters without a network. Loaded on first use, with the scripts of such pages. */
import { ownFolders } from '../files/save/own-files.ts';
import { type WebPage, webPage } from '../files/web-page/web-page.ts';
import type { WebPageOutput } from './protocol.ts';
import { fromMessage } from './settled-takes.ts';

export async function webPageOf(page: WebPage): Promise<WebPageOutput> {
  const characters = page.characters.map(fromMessage);
  const pieces = webPage({ ...page, characters }, await import('virtual:web-page'));
  const [folder = 'marrow'] = ownFolders(characters);
  return { name: `${folder}.html`, page: new Blob([...pieces], { type: 'text/html' }) };
}
