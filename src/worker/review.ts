/** The `review` job: takes in, what the list shows of each out. One file is in memory at a time. */
import { EMPTY_DOCUMENT } from '../model/document.ts';
import { openFiles } from '../project/open/open-files.ts';
import { digestOf, type TakeDigest, type TakeRead } from '../review/digest.ts';
import { parse } from './parse.ts';
import type { GivenBlob, ReviewInput, ReviewOutput } from './protocol.ts';

export async function reviewTakes({ files }: ReviewInput): Promise<ReviewOutput> {
  const takes: TakeDigest[] = [];
  for (const file of files) takes.push(await digest(file));
  return { takes };
}

async function digest(file: GivenBlob): Promise<TakeDigest> {
  const { path } = file;
  const output = await parse({ files: [file] }, () => undefined);
  const { document, diagnostics } = openFiles(EMPTY_DOCUMENT, output.files, output.broken);
  const problem = [...output.diagnostics, ...diagnostics].find(({ severity }) => severity === 'error');
  if (problem) return { path, problem: `${problem.line > 0 ? `Line ${problem.line}: ` : ''}${problem.message}` };
  const takes = document.characters.flatMap(({ skeleton, clips, space }): TakeRead[] =>
    skeleton ? clips.map((clip) => ({ skeleton, clip, space })) : [],
  );
  return digestOf(path, takes);
}
