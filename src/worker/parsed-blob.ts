/** What a file is called, and what may be wrong with it as a whole. */
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { baseName, type SourceFile } from '../model/files.ts';

export function sourceOf(path: string, bytes: number): SourceFile {
  return { name: baseName(path), path, bytes };
}

/** Browsers refuse to pass on larger buffers, with words about `postMessage`. */
const MAX_BYTES = 2 ** 31 - 1;

/** What is wrong if a file's numbers can't be passed from the worker to the page. */
export function tooLargeToPost(
  { name }: SourceFile,
  buffers: readonly { readonly byteLength: number }[],
): Diagnostic | undefined {
  const largest = buffers.reduce((most, { byteLength }) => Math.max(most, byteLength), 0);
  if (largest <= MAX_BYTES) return undefined;
  const found = `Its values need ${(largest / 1e9).toFixed(1)} GB; the page can hold up to ${(MAX_BYTES / 1e9).toFixed(1)} GB per file.`;
  const now = 'The command reads larger files: "marrow convert IN OUT --fps N" writes fewer frames.';
  return withoutPlace('error', 'file-too-large', `${found} ${now}`, name);
}

export function unreadable(source: SourceFile, error: unknown): Diagnostic {
  const reason = error instanceof Error ? error.message : String(error);
  const message = `The file could not be read: ${reason}. It may have moved or be damaged. Try opening it again.`;
  return withoutPlace('error', 'file-unreadable', message, source.name);
}
