/** The `review` job: takes in, what the list shows of each out. One file is in memory at a time. And takes out of zips. */

import { isBesideTakes, isReviewable } from '../files/kinds.ts';
import { openFiles } from '../files/open/open-files.ts';
import { unzip } from '../formats/unzip.ts';
import { EMPTY_DOCUMENT } from '../model/document.ts';
import { digestOf, type TakeDigest, type TakeRead } from '../review/digest.ts';
import { parse } from './parse.ts';
import type { GivenBlob, ReviewInput, ReviewOutput, UnpackInput, UnpackOutput } from './protocol.ts';

export async function reviewTakes({ files, beside }: ReviewInput): Promise<ReviewOutput> {
  const takes: TakeDigest[] = [];
  for (const file of files) takes.push(await digest(file, beside));
  return { takes };
}

/** Only the names are read of a zip with few takes. */
export async function unpackTakes({ zip, most }: UnpackInput): Promise<UnpackOutput> {
  try {
    const bytes = new Uint8Array(await zip.blob.arrayBuffer());
    const names = unzip(bytes, () => false).passedOver;
    if (names.filter(isReviewable).length <= most) return { takes: [] };
    const { entries } = unzip(bytes, (path) => isReviewable(path) || isBesideTakes(path));
    return { takes: entries.map((entry) => ({ path: `${zip.path}/${entry.path}`, blob: new Blob([entry.bytes]) })) };
  } catch {
    // Opening it says what is wrong with it.
    return { takes: [] };
  }
}

async function digest(file: GivenBlob, before: readonly GivenBlob[] = []): Promise<TakeDigest> {
  const { path } = file;
  const output = await parse({ files: [file], before }, () => undefined);
  const { document, diagnostics } = openFiles(EMPTY_DOCUMENT, output.files, output.broken);
  const problem = [...output.diagnostics, ...diagnostics].find(({ severity }) => severity === 'error');
  if (problem) return { path, problem: `${problem.line > 0 ? `Line ${problem.line}: ` : ''}${problem.message}` };
  const found = document.characters.flatMap(({ skeleton, takes, space }): TakeRead[] =>
    skeleton ? takes.map((take) => ({ skeleton, take, space })) : [],
  );
  return digestOf(path, found);
}
