/**
 * What is known of the skins that no file brings back. When a file is read again, the worker works out what there is to
 * know of its skin; of one that is kept as arrays the page itself would have to, in a task as long as the skin is large.
 */
import { skinFacts } from '../../evaluate/bounds.ts';
import type { Document } from '../../model/document.ts';
import type { KnownSkin } from '../../worker/protocol.ts';
import type { Origins } from './origins.ts';

/** Of skins that were shown, or came through the worker, this was worked out long before. */
export function knownSkins({ characters }: Document, origins: Origins): readonly KnownSkin[] {
  return characters.flatMap(({ skins, morphs }) =>
    skins
      .filter((skin) => !isReadTogether([skin, ...morphs], origins))
      .map((skin) => ({ skin, morphs, facts: skinFacts(skin, morphs) })),
  );
}

/** The worker knows a morph's skin only where it reads both. */
function isReadTogether(parts: readonly object[], origins: Origins): boolean {
  const [first, ...others] = parts.map((part) => origins.find(part)?.file.given.opening);
  return first !== undefined && others.every((opening) => opening === first);
}
