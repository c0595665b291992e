/** Encodes a value for an empty store. */
import { allNeeded, StoredChunks } from '../../../src/app/autosave/chunks.ts';
import { Encoder, type FileIndices } from '../../../src/app/autosave/encode.ts';
import type { Origins } from '../../../src/app/autosave/origins.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';

/** The tree, with all that it needs; `files` as its nodes number them. */
export function encodeAll(value: object, origins: Origins) {
  // As before each save.
  runToEnd(origins.look());
  const indices: FileIndices = new Map();
  const draft = new StoredChunks().draft();
  const { tree, needs } = runToEnd(new Encoder(origins, indices, draft).encode(value));
  const all = allNeeded(needs);
  return { tree, needs: all, files: [...indices.keys()], chunks: draft.plan(all.chunks).puts };
}
