/**
 * Precomputed facts of skins that no file brings back. When a file is read again, the worker computes the facts of its
 * skin; for a skin kept as arrays, the page would have to do so itself, in a task as long as the skin is large.
 */
import { skinFacts } from '../../evaluate/skin/bounds.ts';
import type { Document } from '../../model/document.ts';
import type { KnownSkin } from '../../worker/protocol.ts';
import type { Origins } from './origins.ts';

/** Already computed for skins that were shown or came through the worker. */
export function knownSkins({ characters }: Document, origins: Origins): readonly KnownSkin[] {
  return characters.flatMap(({ skins, morphs }) =>
    skins
      .filter((skin) => !isReadTogether([skin, ...morphs], origins))
      .map((skin) => ({ skin, morphs, facts: skinFacts(skin, morphs) })),
  );
}

/** The worker knows a morph's skin only if it reads both. */
function isReadTogether(parts: readonly object[], origins: Origins): boolean {
  const [first, ...others] = parts.map((part) => origins.find(part)?.file.given.opening);
  return first !== undefined && others.every((opening) => opening === first);
}
