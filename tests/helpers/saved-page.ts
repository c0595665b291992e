/** What a saved page holds, as a browser reads it: for tests without one. */
import { inflateRawSync } from 'node:zlib';
import { readCharacters } from '../../src/files/web-page/read-characters.ts';
import { type WebPage, webPage } from '../../src/files/web-page/web-page.ts';
import { fromBase91 } from '../../src/formats/base91.ts';
import type { Character } from '../../src/model/document.ts';

const SCRIPTS = { viewer: 'viewer', loader: 'loader', style: 'style', policy: 'policy' };

export function pageOf(characters: readonly Character[], more: Partial<WebPage> = {}): string {
  return webPage({ characters, theme: 'light', attributes: { controls: '' }, ...more }, SCRIPTS).join('');
}

const SIGNS: Readonly<Record<string, string>> = { amp: '&', lt: '<', gt: '>', quot: '"' };

export function unescaped(text: string): string {
  return text.replace(/&(amp|lt|gt|quot);/g, (_, name: string) => SIGNS[name]);
}

/** By path. */
export function filesIn(page: string): ReadonlyMap<string, Uint8Array<ArrayBuffer>> {
  const parts = page.matchAll(/<pre hidden data-(file|packed)="([^"]*)">\n([^<]*)<\/pre>/g);
  return new Map(
    [...parts].map(([, how, name, text]) => [
      unescaped(name),
      how === 'file' ? new TextEncoder().encode(unescaped(text)) : new Uint8Array(inflateRawSync(fromBase91(text))),
    ]),
  );
}

/** The characters of a page, as its viewer opens them. */
export function openedFrom(page: string) {
  const files = [...filesIn(page)].map(([path, bytes]) => ({ path, bytes }));
  const shown = /<pre hidden data-shown>\n([^<]*)<\/pre>/.exec(page)?.[1] ?? '[]';
  return readCharacters(files, JSON.parse(unescaped(shown)));
}
