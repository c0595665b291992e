/** The `changes` and `check` jobs: what the page changed in a text file, and what was edited in the text. */

import { changedText, rewritten } from '../files/changes/changed-text.ts';
import type { Owned } from '../files/save/owned.ts';
import { writeFile } from '../files/writers.ts';
import { mapSource } from '../formats/source/map-source.ts';
import { partsOf } from '../model/character-parts.ts';
import { parse } from './parse.ts';
import type { ChangesInput, ChangesOutput, CheckInput, CheckOutput, GivenBlob, Progress } from './protocol.ts';
import { textIn } from './source.ts';

export async function changesOf({ file, source, owned }: ChangesInput): Promise<ChangesOutput> {
  const bytes = await (await textIn(file)).arrayBuffer();
  // The byte order mark is a part of the text that stays.
  const original = new TextDecoder('utf-8', { ignoreBOM: true }).decode(bytes);
  const { text, hunks } = changedText(source, original, owned);
  if (hunks.length === 0) return { hunks };
  const changed = new TextEncoder().encode(text);
  return { hunks, changed: { text: new Blob([changed]), map: mapSource(changed, source.name) } };
}

export async function checkText(
  { source, edited, base, owned }: CheckInput,
  onProgress: (progress: Progress) => void,
): Promise<CheckOutput> {
  const { path } = source;
  const before = skeletonBeside(owned);
  const output = await parse({ files: [{ path, blob: new Blob([edited]) }], before }, onProgress);
  const diagnostics = output.diagnostics.filter(({ code }) => code !== 'part-given-before');
  const isSame = output.files.length > 0 && rewritten(source, edited, owned) === rewritten(source, base, owned);
  return { ...output, diagnostics, isSame };
}

/** The skeleton of a motion of Acclaim, as it is now. */
function skeletonBeside([first]: readonly Owned[]): readonly GivenBlob[] {
  if (first?.part.kind !== 'amc') return [];
  return partsOf(first.character).flatMap(({ kind, content, file }) => {
    const written = kind === 'asf' && file && writeFile({ kind, skeleton: content }, file.name);
    return written && 'text' in written ? [{ path: file.path, blob: new Blob([written.text]) }] : [];
  });
}
