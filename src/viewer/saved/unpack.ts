/** What a saved page has in it: see `files/web-page/web-page.ts`. */
import { fromBase91 } from '../../formats/base91.ts';

/** The bytes that a text was packed from. Rejects if it was changed. */
export function unpack(text: string): Promise<ArrayBuffer> {
  const inflated = new Blob([fromBase91(text)]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
  return new Response(inflated).arrayBuffer();
}
