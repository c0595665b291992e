/** Reads the text of a file for `SourceTexts`, which keeps where it is; loaded once a text is shown. */
import type { DiskFile } from '../io/disk-files.ts';
import type { GivenFile } from '../io/given.ts';
import type { SourceMap } from '../model/source-map.ts';
import type { Runs } from '../worker/client.ts';
import type { SourceInput } from '../worker/protocol.ts';
import type { DiskHandles } from './disk-handles.ts';

export interface TextParts {
  readonly worker: Runs<'source'>;
  readonly handles: Pick<DiskHandles, 'at'>;
  /** `readAgain` of `io/disk-access.ts`. */
  readAgain(file: DiskFile, signal: AbortSignal): Promise<GivenFile>;
}

/** Where a text is. */
export interface FoundText {
  readonly blob: Blob;
  /** Its path in the blob, which is a zip then. */
  readonly inside?: string;
}

/** As `SourceFiles.read`. */
export async function readText(
  { worker }: Pick<TextParts, 'worker'>,
  file: SourceInput,
  signal: AbortSignal,
  onText: (text: Blob) => void,
  onProgress: (share: number) => void,
): Promise<SourceMap> {
  signal.throwIfAborted();
  if (file.inside === undefined) onText(file.blob);
  const { map, text } = await worker.run('source', file, {
    signal,
    onProgress: ({ done, of }) => onProgress(of > 0 ? done / of : 0),
  });
  if (text) onText(text);
  return map;
}

/**
 * @param found where it was given in this session; absent: it is read from disk
 * @param inside its path in a zip, if it may be in one
 */
export async function findText(
  { handles, readAgain }: Pick<TextParts, 'handles' | 'readAgain'>,
  path: string,
  found: FoundText | undefined,
  inside: string | undefined,
  signal: AbortSignal,
): Promise<SourceInput> {
  if (found) return { path, ...found };
  const file = handles.at(path);
  if (!file) throw new Error('Its text is no longer available. Open the file again.');
  const { blob } = await readAgain(file, signal);
  return { path, blob, ...(file.path !== path && inside !== undefined && { inside }) };
}
