/** The `changes` and `check` jobs: what the page changed in a text file, and what was edited in the text. */

import { provideRetargeting } from '../evaluate/retarget/driving.ts';
import { changedText, rewritten, skeletonBeside } from '../files/changes/changed-text.ts';
import { skeletonKindFor } from '../files/kinds.ts';
import { mapSource } from '../formats/source/map-source.ts';
import { parse } from './parse.ts';
import type { ChangesInput, ChangesOutput, CheckInput, CheckOutput, Progress } from './protocol.ts';
import { textIn } from './source.ts';

export async function changesOf({ file, source, owned }: ChangesInput): Promise<ChangesOutput> {
  // Plain takes are evaluated.
  provideRetargeting();
  const bytes = await (await textIn(file)).arrayBuffer();
  // The byte order mark is a part of the text that stays.
  const original = new TextDecoder('utf-8', { ignoreBOM: true }).decode(bytes);
  const { text, hunks } = await changedText(source, original, owned);
  if (hunks.length === 0) return { hunks };
  const changed = new TextEncoder().encode(text);
  return { hunks, changed: { text: new Blob([changed]), map: mapSource(changed, source.name) } };
}

export async function checkText(
  { source, edited, base, owned }: CheckInput,
  onProgress: (progress: Progress) => void,
): Promise<CheckOutput> {
  const { path } = source;
  const skeleton = skeletonKindFor(path) ? skeletonBeside(owned) : undefined;
  const before = skeleton ? [{ path: skeleton.source.path, blob: new Blob([skeleton.text]) }] : [];
  const output = await parse({ files: [{ path, blob: new Blob([edited]) }], before }, onProgress);
  const diagnostics = output.diagnostics.filter(({ code }) => code !== 'part-given-before');
  const isSame =
    output.files.length > 0 && (await rewritten(source, edited, owned)) === (await rewritten(source, base, owned));
  return { ...output, diagnostics, isSame };
}
