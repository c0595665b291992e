/** What the numbers of a dump turned out to be. */
import type { ComparedResult } from '../../state/dump-comparison.ts';

/** Whether a dump has nothing but values of channels: these have times of their own. */
export function isOfChannels({ targets }: ComparedResult, fileName: string): boolean {
  const { origins, frames } = targets;
  if (!origins) return frames.length === 0;
  const dump = origins.fileNames.indexOf(fileName);
  return dump >= 0 && !origins.frames.some((kinds) => Object.values(kinds).includes(dump));
}
