/** The `source` job: where the lines of a text file are, and what they hold. A file inside a zip is unpacked first. */

import { SourceMapper } from '../formats/source/map-source.ts';
import { unzip } from '../formats/unzip.ts';
import type { Progress, SourceInput, SourceOutput } from './protocol.ts';

/** Interval of progress messages. */
const PROGRESS_STEP_BYTES = 1 << 22;

export async function mapSourceOf(input: SourceInput, onProgress: (progress: Progress) => void): Promise<SourceOutput> {
  const { path, blob } = input;
  const name = path.slice(path.lastIndexOf('/') + 1);
  const text = await textIn(input);
  const mapper = new SourceMapper(name);
  const reader = text.stream().getReader();
  let done = 0;
  let told = 0;
  for (let next = await reader.read(); !next.done; next = await reader.read()) {
    mapper.feed(next.value);
    done += next.value.byteLength;
    if (done - told < PROGRESS_STEP_BYTES) continue;
    told = done;
    onProgress({ label: name, done, of: text.size });
  }
  return { map: mapper.finish(), ...(text !== blob && { text }) };
}

/** A file, which may be in a zip. */
export async function textIn({ blob, inside }: SourceInput): Promise<Blob> {
  return inside === undefined ? blob : await unpacked(blob, inside);
}

async function unpacked(zip: Blob, inside: string): Promise<Blob> {
  const { entries } = unzip(new Uint8Array(await zip.arrayBuffer()), (path) => path === inside);
  const [entry] = entries;
  if (!entry) throw new Error(`The zip no longer contains ${inside}.`);
  return new Blob([entry.bytes]);
}
