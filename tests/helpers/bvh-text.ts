/** `.bvh` as one text. */
import { writeBvh as write } from '../../src/formats/bvh/write.ts';
import type { WriteResult } from '../../src/formats/reader.ts';
import type { Capture } from '../../src/model/files.ts';

export function writeBvh(captures: readonly Capture[], name = ''): WriteResult {
  const { pieces, diagnostics } = write(captures, name);
  const decoder = new TextDecoder();
  let text = '';
  for (const piece of pieces) text += decoder.decode(piece, { stream: true });
  return { text, diagnostics: diagnostics() };
}
